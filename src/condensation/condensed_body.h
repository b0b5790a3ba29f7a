#pragma once

#include <Eigen/Dense>
#include <array>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "body/cell_products.h"
#include "body/operator.h"
#include "body/prescribed.h"
#include "condensation/factorisation.h"
#include "condensation/factorisation_choice.h"

namespace tourmaline::condensation {

/// The body of one step size, factorised once and condensed onto some of its unknowns c, those that
/// the contact acts on: S c = s + q, with q what the contact adds to the right side of their rows.
/// Of displacements these are nodal forces on the body [N]. S is symmetric; in displacements alone
/// it is positive definite once the body is held, with potentials or temperatures among c it is
/// quasi-definite (docs/theory.md, section 4).
///
/// Inside, the unknowns of each field are scaled by the square root of the field's largest diagonal
/// entry, so that the factorised matrix is balanced in any units; all arguments here are SI.
template <int dim>
class CondensedBody {
 public:
  /// `prescribed` unknowns are taken out of the matrix, but for those among `contact`, the unknowns
  /// c: these stay in c and the interface prescribes them.
  CondensedBody(const body::Discretisation<dim> &body, const body::Operator<dim> &op, double step,
                const std::vector<body::Prescribed> &prescribed,
                const std::vector<std::size_t> &contact, const FactorisationChoice &choice);

  /// What the factorisation without pivoting takes, told before any number is computed.
  struct Plan {
    std::size_t unknowns = 0, kept = 0;  ///< kept: of them those of c
    std::size_t fronts = 0;
    long long entries = 0;  ///< of the factor
    double operations = 0;
  };
  static Plan plan(const body::Operator<dim> &op, double step,
                   const std::vector<body::Prescribed> &prescribed,
                   const std::vector<std::size_t> &contact);

  /// In the order of `contact`. Only on the first rank; empty on the others.
  const Eigen::MatrixXd &stiffness() const { return stiffness_; }

  /// s from the right-hand side of a step, on every rank; `state` holds the values of prescribed
  /// unknowns.
  Eigen::VectorXd reduce(std::span<const double> right_side, std::span<const double> state);

  /// Fills the unknowns of `state` that are not prescribed, from c, on every
  /// rank.
  void expand(const Eigen::VectorXd &c, std::span<double> state);

  /// |b - K x| / (|K| |x| + |b|) over the free unknowns, scaled, in the maximum norm; of q what
  /// supports bear at prescribed components does not count.
  double backward_error(std::span<const double> right_side, std::span<const double> state,
                        const Eigen::VectorXd &q) const;

  /// Size of K^-1 (b - K x), the factor's answer to what `state` leaves of the equations inside,
  /// over that of x: an estimate of the forward error of all unknowns but c, by field the largest
  /// scaled entries, the worst field's. A field of which there is next to nothing (a millionth of
  /// the largest, an energy of 1e-12) is measured by that millionth. The residual is that of
  /// `cells`: with assembled entries their own round-off would stay unseen.
  double forward_error(const body::CellProducts<dim> &cells, std::span<const double> right_side,
                       std::span<const double> state);

  /// From now on stiffness, `reduce` and `expand` are those of `cells`, by iterative refinement:
  /// GMRES with the factor for its preconditioner takes down the residual of `cells`, so an
  /// operator whose assembled entries determine no digit of x is solved as long as few of its
  /// directions are so weak. Every solution takes tens of substitutions, the stiffness one solution
  /// for each entry of c. `cells` outlives this object.
  void refine(const body::CellProducts<dim> &cells);
  bool is_refined() const { return cells_ != nullptr; }
  /// Of the refined solutions since the last call: size of the last correction, as `forward_error`.
  double left_by_refinement() { return std::exchange(left_by_refinement_, 0.); }

  const FactorisationStatistics &statistics() const { return statistics_; }
  std::size_t n_unknowns() const { return unknown_of_.size(); }
  /// Free electric and thermal unknowns, and those of them that are not in c: as many negative
  /// pivots are right.
  std::size_t n_electric_and_thermal() const { return n_electric_and_thermal_; }
  std::size_t n_electric_and_thermal_inside() const { return n_electric_and_thermal_inside_; }

 private:
  CondensedBody(const body::Operator<dim> &op, double step)
      : operator_(op), step_(step), scale_(op.scales(step)) {}
  void number(const std::vector<body::Prescribed> &prescribed,
              const std::vector<std::size_t> &contact);
  std::vector<double> scales() const;
  std::vector<body::Node> nodes_in_order() const;
  std::vector<int> elimination_order(const std::vector<body::Node> &node_at) const;
  void factorise(const body::Discretisation<dim> &body, const FactorisationChoice &choice);
  std::string weak_pivot_in_words(const body::Discretisation<dim> &body, int variable) const;
  bool is_contact_variable(std::size_t v) const { return is_contact_variable_[v]; }
  Eigen::VectorXd residual_inside(const body::CellProducts<dim> &cells,
                                  std::span<const double> right_side,
                                  std::span<const double> state) const;
  Eigen::VectorXd solve_inside(const Eigen::VectorXd &residual);
  Eigen::VectorXd product_inside(const Eigen::VectorXd &x) const;
  double relative_size(const Eigen::VectorXd &correction, std::span<const double> state) const;
  Eigen::VectorXd reduce_refined(std::span<const double> right_side, std::span<const double> state);
  void solve_refined(std::span<const double> right_side, std::span<double> state);
  void impose(const Eigen::VectorXd &c, std::span<double> state) const;
  Eigen::VectorXd contact_rows(std::span<const double> state) const;
  double scale(std::size_t unknown) const { return scale_[unknown % body::Fields<dim>::count]; }
  double contact_scale(Eigen::Index i) const { return scale(unknown_of_[contact_variables_[i]]); }

  const body::Operator<dim> &operator_;
  double step_;
  std::vector<int> variable_of_;         // by unknown of the body; -1: prescribed
  std::vector<std::size_t> unknown_of_;  // by variable of the matrix
  std::vector<std::size_t> prescribed_;  // unknowns taken out
  std::vector<bool> is_prescribed_;      // by unknown of the body, also in contact
  std::vector<int> contact_variables_;
  std::vector<bool> is_contact_variable_;
  std::array<double, body::Fields<dim>::count> scale_;
  std::size_t n_electric_and_thermal_ = 0, n_electric_and_thermal_inside_ = 0;
  std::unique_ptr<Factorisation> factorisation_;
  FactorisationStatistics statistics_;
  Eigen::MatrixXd stiffness_;
  const body::CellProducts<dim> *cells_ = nullptr;  // once refined
  std::vector<double> given_, inside_;              // of the refined step: b; x at c = 0
  double left_by_refinement_ = 0;
  std::vector<double> right_side_, lifted_;  // kept, so that a step allocates nothing
};

}  // namespace tourmaline::condensation
