#pragma once

#include <array>
#include <span>
#include <vector>

#include "tourmaline/body/discretisation.h"
#include "tourmaline/case/formula.h"
#include "tourmaline/material/plane.h"

namespace tourmaline::body {

/// Unknowns of one node: u_1 ... u_dim, phi, theta, in this order.
template <int dim>
struct Fields {
  static constexpr int potential = dim, temperature = dim + 1, count = dim + 2;
};

/// Index of an unknown in vectors over the whole body, `node * (dim + 2) + component`.
template <int dim>
constexpr std::size_t unknown(Node node, int component) {
  return std::size_t{node} * Fields<dim>::count + component;
}

/// Power-conjugate sums x_a . K_ab y_b of the storage operator by field: mechanical, electric,
/// thermal.
using FieldForms = std::array<std::array<double, 3>, 3>;

/// The operator of the body without boundary conditions, in SI units. With the electric rows
/// multiplied by -1 and the heat rows by -k / theta_ref it is symmetric (design: operator of a
/// step):
///
///     storage    [  A     E^T   -M  ]     A = (F eps(v), eps(v))     H0 = (alpha eta, eta)
///                [  E    -B      P  ]     B = (beta grad psi, grad psi)
///                [ -M^T   P^T   -H0 ]     E, M, P the couplings of (1), (2), (6)
///
///     conduction G = (K grad eta, grad eta) + (k_c eta, eta) on Gamma_C, rows and columns of theta
///     only
///
/// so that the step of (31)-(33) has the operator storage - (k / theta_ref) G, and its heat rows
/// see the state before through the heat rows of `storage`.
template <int dim>
class Operator {
 public:
  static constexpr int n = Fields<dim>::count;
  using Block = Eigen::Matrix<double, n, n, Eigen::RowMajor>;

  Operator(const Discretisation<dim> &body, const material::BodyConstants<dim> &material);

  /// Adds (k_c theta, eta) on the named boundaries (18); `coefficient` is k_c [W/(K m^2)], by
  /// place.
  void add_exchange(const Discretisation<dim> &body, const std::vector<std::string> &boundaries,
                    const casefile::Formula &coefficient);

  const NodeGraph &graph() const { return graph_; }
  double reference_temperature() const { return reference_temperature_; }

  /// Block of storage - step / theta_ref G at place `entry` of the graph; `step` = k [s].
  Block step_block(std::size_t entry, double step) const;

  /// y = (storage - step / theta_ref G) x.
  void multiply(double step, std::span<const double> x, std::span<double> y) const;

  /// Adds the heat rows of storage x to y: what a step remembers of the state x before it (6),
  /// (33).
  void add_history(std::span<const double> x, std::span<double> y) const;

  /// Row `row` of (storage - step / theta_ref G) times x.
  double row_times(std::size_t row, double step, std::span<const double> x) const;

  /// Column `column` times `value`, subtracted from y (the operator is symmetric).
  void subtract_column(std::size_t column, double step, double value, std::span<double> y) const;

  /// Forms of the storage operator between x and y, by field.
  FieldForms forms(std::span<const double> x, std::span<const double> y) const;

 private:
  std::size_t entry_of(Node row, Node column) const;

  NodeGraph graph_;
  std::vector<Block, Eigen::aligned_allocator<Block>> storage_;
  std::vector<double> conduction_;
  double reference_temperature_;
};

}  // namespace tourmaline::body
