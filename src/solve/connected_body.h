#pragma once

#include <Eigen/Dense>
#include <span>
#include <vector>

#include "condensation/condensed_body.h"
#include "dense/decompositions.h"
#include "output/checkpoint.h"
#include "solve/circuit.h"
#include "solve/electrode_history.h"
#include "solve/exchange_nodes.h"
#include "solve/model.h"

namespace tourmaline::solve {

/// The condensed body with its electrodes in their circuit. The body is factorised with every
/// electrode's potential prescribed, at 0 where its voltage is not given. Such voltages V, m of
/// them, then enter by superposition: with the response psi_e of the body to the unit voltage of
/// electrode e at c = 0, and x_p the prescribed values,
///
///     S c - G V = s + q,         G_e  = -(K psi_e) in the rows of c,
///     Q = C V + G^T c + Q0,      C_ef = -psi_e.K psi_f, positive definite,
///                                Q0_e = psi_e.(b - K x_p),
///
/// and with the circuit, Q + Y V = j, V is eliminated exactly: with Z = (C + Y)^-1
///
///     (S + G Z G^T) c = s + G Z (j - Q0) + q.
///
/// What is added to S is not negative, so the contact problem stays strictly convex; an electrode
/// that is not held stiffens the body (docs/theory.md).
template <int dim>
class ConnectedBody {
 public:
  explicit ConnectedBody(const Model<dim> &model);

  /// A run begins whose initial state has been settled to this one (`settle`).
  void begin(std::span<const double> settled);

  /// As of `CondensedBody`, all with the electrodes in their circuit.
  const Eigen::MatrixXd &stiffness() const;
  Eigen::VectorXd reduce(double time, std::span<const double> right_side,
                         std::span<const double> state);
  /// Ends the step: its charges and voltages are what the next one starts from.
  void expand(const Eigen::VectorXd &c, std::span<double> state);

  /// The step that was ended is to be solved again.
  void take_back() { history_.take_back(); }

  /// As of `CondensedBody`; the step at hand is to be solved again, from `reduce` on.
  void refine();

  const condensation::CondensedBody<dim> &body() const { return body_; }
  condensation::CondensedBody<dim> &body() { return body_; }

  /// As of `Route`.
  void save(output::SavedNumbers &numbers) const;
  void restore(const output::SavedNumbers &numbers);

 private:
  void add_responses();
  std::vector<double> product(const std::vector<double> &x) const;
  Eigen::VectorXd charges_at_rest(std::span<const double> right_side,
                                  std::span<const double> state) const;

  const Model<dim> &model_;
  std::vector<std::size_t> contact_;  // the unknowns c
  condensation::CondensedBody<dim> body_;
  Circuit circuit_;
  ElectrodeHistory<dim> history_;
  std::vector<std::size_t> lifted_;                       // prescribed unknowns that are not in c
  std::vector<std::vector<double>> response_, reaction_;  // psi and K psi, by free electrode
  Eigen::MatrixXd coupling_;                              // G [C/m]
  dense::Cholesky admittance_;                            // C + Y [F]
  Eigen::MatrixXd stiffness_;
  Eigen::VectorXd supplied_, released_;  // of this step: j, and what is left of it for V [C]
};

}  // namespace tourmaline::solve
