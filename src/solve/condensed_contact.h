#pragma once

#include <Eigen/Dense>
#include <span>
#include <string>
#include <vector>

#include "output/checkpoint.h"
#include "solve/connected_body.h"
#include "solve/contact_nodes.h"
#include "solve/coupled_programme.h"
#include "solve/exchange_nodes.h"
#include "solve/kept_factor.h"
#include "solve/model.h"
#include "solve/route.h"

namespace tourmaline::solve {

/// The contact of a condensed body: S c - s are its forces, and what flows through it, on the
/// unknowns c of `ConnectedBody`. Its own unknowns are slips and penetrations d, c = c_stuck + T d,
/// and temperatures and potentials where these are exchanged. The first rank, which has S, solves
/// for them; all know the outcome.
template <int dim>
class CondensedContact {
 public:
  /// What these refer to outlives this. The model has a contact. Collective, as all that is not
  /// const.
  CondensedContact(const Model<dim> &model, const ConnectedBody<dim> &body);

  /// T^T S T of an S that is another now. The next step starts from no increment.
  void condense();
  /// Its own share of a solution's relative forward error: what round-off of S's entries does.
  double error() const { return error_; }

  /// Solves the step for c, on the first rank. Throws SolveError, UnsettledStep.
  StepOutcome advance(double time, const Eigen::VectorXd &s, std::span<const double> before,
                      std::span<const double> state, Eigen::VectorXd &c);
  /// S c - s of a step.
  Eigen::VectorXd reactions(const StepOutcome &outcome) const;
  /// Where the next step's iteration starts [m].
  const Eigen::VectorXd &last_increment() const { return last_increment_; }
  void start_from(const Eigen::VectorXd &increment) { last_increment_ = increment; }

  void take_back();
  void set_accumulated_slip(const Eigen::VectorXd &slip) { nodes_.set_accumulated_slip(slip); }
  /// Of pivots in rows of what is exchanged those that are negative.
  int negative_pivots() const { return exchanges() ? negative_at_contact_ : 0; }

  /// As of `Route`.
  void save(output::SavedNumbers &numbers) const;
  void restore(const output::SavedNumbers &numbers);
  void forget_matrices() { factor_ = whole_factor_ = {}; }

 private:
  void condense_onto_slips();
  void condense_exchanges();
  double error_of_slips() const;
  bool exchanges() const { return exchange_.size() > 0; }
  InterfaceSettings settings(KeptFactor *factor) const;
  CoupledSolution solve_programme(const InterfaceProgramme &programme, const Eigen::VectorXd &start,
                                  const InterfaceSettings &settings) const;
  CoupledSolution solve_with_exchange(double time, const Eigen::VectorXd &s,
                                      const Eigen::VectorXd &start);
  void require_solved(double time, const Eigen::VectorXd &s, const InterfaceProgramme &programme,
                      const InterfaceSolution &solution) const;
  CoupledSolution solve_contact(double time, const Eigen::VectorXd &s,
                                const Eigen::VectorXd &start);
  Eigen::VectorXd sharpen(double time, const Eigen::VectorXd &s, CoupledSolution &solution);
  bool is_lost(double time, const Eigen::VectorXd &s, const InterfaceProgramme &programme,
               const InterfaceSolution &solution) const;
  [[noreturn]] void give_up(double time, const InterfaceSolution &solution) const;
  void advance_on_first(double time, const Eigen::VectorXd &s, std::span<const double> before,
                        std::span<const double> state, Eigen::VectorXd &c, StepOutcome &outcome);

  const Model<dim> &model_;
  const ConnectedBody<dim> &body_;
  std::string left_to_contact_;  // rigid motions
  bool is_alone_;                // the contact, in resisting them: there is no damping
  std::vector<bool> is_prescribed_;
  ContactNodes<dim> nodes_;
  ExchangeNodes<dim> exchange_;
  Eigen::MatrixXd slip_stiffness_;  // T^T S T, T the directions of the contact's unknowns
  KeptFactor factor_;
  Eigen::VectorXd last_increment_;
  // Where temperatures or potentials are unknowns of the contact, too: the matrix with their rows.
  Eigen::MatrixXd whole_stiffness_;
  KeptFactor whole_factor_;
  int negative_at_contact_ = 0;  // pivots in their rows
  double error_ = 0;
};

}  // namespace tourmaline::solve
