#pragma once

#include <Eigen/Dense>
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "tourmaline/body/conditions.h"
#include "tourmaline/body/operator.h"
#include "tourmaline/condensation/factorisation.h"

namespace tourmaline::condensation {

/// The body of one step size, factorised once and condensed onto the displacements c of the contact
/// nodes: S c = s + q, with q the nodal forces of the contact on the body [N], S [N/m] symmetric
/// and, once the body is held, positive definite.
///
/// Inside, the unknowns of each field are scaled by the square root of the field's largest diagonal
/// entry, so that the factorised matrix is balanced in any units; all arguments here are SI.
template <int dim>
class CondensedBody {
 public:
  /// `prescribed` unknowns are taken out of the matrix, but for those at contact nodes'
  /// displacements: these stay in c and the interface prescribes them.
  CondensedBody(const body::Operator<dim> &op, double step,
                const std::vector<body::Prescribed> &prescribed,
                const std::vector<body::Node> &contact_nodes, int threads);

  /// dim entries for each contact node, in the order of `contact_nodes`. Only on the first rank;
  /// empty on the others.
  const Eigen::MatrixXd &stiffness() const { return stiffness_; }

  /// s [N] from the right-hand side of a step, on every rank; `state` holds the values of
  /// prescribed unknowns.
  Eigen::VectorXd reduce(std::span<const double> right_side, std::span<const double> state);

  /// Fills the unknowns of `state` that are not prescribed, from the contact displacements c [m],
  /// on every rank.
  void expand(const Eigen::VectorXd &c, std::span<double> state);

  /// |b - K x| / (|K| |x| + |b|) over the free unknowns, scaled, in the maximum norm; q [N] are the
  /// forces at the contact.
  double backward_error(std::span<const double> right_side, std::span<const double> state,
                        const Eigen::VectorXd &q) const;

  const FactorisationStatistics &statistics() const { return factorisation_->statistics(); }
  std::size_t n_unknowns() const { return unknown_of_.size(); }
  /// Free electric and thermal unknowns: as many negative pivots are right.
  std::size_t n_electric_and_thermal() const { return n_electric_and_thermal_; }

 private:
  void number(const std::vector<body::Prescribed> &prescribed,
              const std::vector<body::Node> &contact_nodes);
  void scale_fields();
  std::vector<int> elimination_order() const;
  double scale(std::size_t unknown) const { return scale_[unknown % body::Fields<dim>::count]; }

  const body::Operator<dim> &operator_;
  double step_;
  std::vector<int> variable_of_;         // by unknown of the body; -1: prescribed
  std::vector<std::size_t> unknown_of_;  // by variable of the matrix
  std::vector<std::size_t> prescribed_;  // unknowns taken out
  std::vector<int> contact_variables_;
  std::array<double, body::Fields<dim>::count> scale_{};
  std::size_t n_electric_and_thermal_ = 0;
  std::optional<Factorisation> factorisation_;
  Eigen::MatrixXd stiffness_;
  std::vector<double> right_side_, lifted_;  // kept, so that a step allocates nothing
};

}  // namespace tourmaline::condensation
