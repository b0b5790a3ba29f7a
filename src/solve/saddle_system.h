#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "body/operator.h"
#include "body/prescribed.h"
#include "condensation/saddle_factorisation.h"
#include "contact/multipliers.h"

namespace tourmaline::solve {

/// x = (u, phi, theta, lambda) of (43), or a residual or an increment of it: all unknowns of the
/// body, then the multipliers point by point.
struct SaddlePoint {
  std::vector<double> body;
  Eigen::VectorXd multipliers;
};

/// What the residual of a step depends on besides x: loads and history, the state of the last step,
/// whose contact nodes moved on with the foundation, a state in which the contact nodes touch it,
/// and the contact law at each multiplier's point.
struct StepData {
  std::span<const double> right_side, before, rest;
  const std::vector<contact::AugmentedLagrangian> &laws;
};

/// The nonlinear system of a step, R = A + G + F (37), and its tangent Q/k + K + T (43), in the
/// signs of `body::Operator`, which make the tangent symmetric:
///
///     body rows         K x - b + sum_i w_i (d y_i / du)^T dl_i/dy
///     multiplier rows   w_i dl_i/dlambda
///
/// with l_i the augmented Lagrangian at point i and y_i the displacement that it sees; K and b hold
/// (38), (39) and the heat exchange of (42). Inside, each field is scaled by the root of its
/// largest diagonal entry and each multiplier so that its coupling is of the size 1.
template <int dim>
class SaddleSystem {
 public:
  using Point = contact::MultiplierPoint<dim>;

  /// `crossing`: free unknowns theta and phi that `set_slopes` acts on.
  SaddleSystem(const body::Operator<dim> &op, double step,
               const std::vector<body::Prescribed> &prescribed, std::vector<Point> points,
               const std::vector<std::size_t> &crossing, int threads);

  /// From now on K is less these on the diagonal of the crossing unknowns.
  void set_slopes(const Eigen::VectorXd &slopes) { slope_ = slopes; }

  const std::vector<Point> &points() const { return points_; }
  contact::Local displacement(std::size_t point, const SaddlePoint &x, const StepData &data) const;
  /// What it changes by along x.
  contact::Local change(std::size_t point, const SaddlePoint &x) const;
  contact::Local multiplier(std::size_t point, const SaddlePoint &x) const;
  void set_multiplier(std::size_t point, const contact::Local &value, SaddlePoint &x) const;

  /// R(x); zero in prescribed rows.
  SaddlePoint residual(const StepData &data, const SaddlePoint &x) const;
  /// Largest sum |K| |x| + |b| of a row.
  struct RowSizes {
    std::array<double, 3> of_field{};  ///< [N], and in the scaled rows of phi and theta
    std::vector<double> at_point;      ///< by contact point, of its nodes' mechanical rows [N]
  };
  RowSizes row_sizes(const StepData &data, const SaddlePoint &x) const;
  /// Largest entry, by field, of the body rows of a residual.
  std::array<double, 3> largest_rows(const SaddlePoint &residual) const;

  /// Assembles and factorises the tangent at x.
  void factorise(const StepData &data, const SaddlePoint &x);
  /// -tangent^-1 residual (44), zero in prescribed unknowns.
  SaddlePoint increment(const SaddlePoint &residual);

  /// K x, less slopes: the body's part of the tangent.
  std::vector<double> body_times(const std::vector<double> &x) const;
  double largest_displacement(const SaddlePoint &x) const;  ///< of a component [m]

  /// Of the components of a node.
  const std::array<double, body::Fields<dim>::count> &field_scales() const { return field_scale_; }
  bool is_free(std::size_t unknown) const { return variable_of_[unknown] >= 0; }
  std::size_t n_variables() const { return scale_.size(); }
  std::size_t n_multipliers() const { return scale_.size() - unknown_of_.size(); }
  std::size_t n_electric_and_thermal() const;
  /// Mean diagonal entry of the displacement of a point's nodes over its weight [N/m^3].
  double stiffness_at(std::size_t point) const { return stiffness_[point]; }
  const condensation::SaddleFactorisation &factorisation() const { return *factorisation_; }
  double substitution_seconds() const { return substitution_seconds_; }

 private:
  void number(const std::vector<body::Prescribed> &prescribed);
  void set_scales();
  void add_contact_pattern(condensation::SymmetricMatrix &matrix) const;
  void add_crossing_pattern(condensation::SymmetricMatrix &matrix) const;
  std::vector<int> elimination_order() const;
  std::vector<int> local_variables(std::size_t point) const;
  Eigen::MatrixXd local_tangent(const Point &point,
                                const contact::AugmentedLagrangian::Hessian &hessian) const;
  std::vector<double> scaled(const SaddlePoint &x) const;
  SaddlePoint unscaled(const std::vector<double> &variables) const;

  const body::Operator<dim> &operator_;
  double step_;
  std::vector<Point> points_;
  std::vector<std::size_t> crossing_;
  Eigen::VectorXd slope_;                // by crossing unknown
  std::vector<std::size_t> offset_;      // of each point's multipliers
  std::vector<int> variable_of_;         // by unknown of the body; -1: prescribed
  std::vector<std::size_t> unknown_of_;  // by variable; multipliers follow
  std::vector<double> scale_;            // by variable
  std::array<double, body::Fields<dim>::count> field_scale_;
  std::vector<double> stiffness_;  // by point
  std::vector<double> zero_;       // no state at all
  std::size_t n_body_entries_ = 0;
  double substitution_seconds_ = 0;
  std::optional<condensation::SaddleFactorisation> factorisation_;
};

}  // namespace tourmaline::solve
