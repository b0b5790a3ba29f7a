#pragma once

#include <Eigen/Dense>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "output/checkpoint.h"
#include "solve/body_by_solutions.h"
#include "solve/body_equations.h"
#include "solve/contact_nodes.h"
#include "solve/coupled_programme.h"
#include "solve/held_exchanges.h"
#include "solve/model.h"
#include "solve/route.h"

namespace tourmaline::solve {

/// The contact of a step of the iterative route, and with it the state: Newton's method on all
/// unknowns at once and, where that gains nothing, a safe stage that asks the body for its answers.
template <int dim>
class ContactBySolutions {
 public:
  /// What is referred to outlives this. `count`: where safe stages are counted. `is_leaning`: only
  /// the contact keeps the body from some rigid motion. `tolerance`: the residual of the contact,
  /// over the size of the forces, that counts as none. `say`: as `Route::say`.
  ContactBySolutions(const Model<dim> &model, const std::vector<bool> &is_prescribed,
                     BodyEquations<dim> &body, RouteReport &count, bool is_leaning,
                     double tolerance, Route::Listener say);

  /// A step from `before` to a state that is predicted. The body's equations have begun theirs.
  void begin_step(double time, std::span<const double> before, std::span<double> state);
  /// Solves the step from where the state is. False where the contact did not settle.
  bool settle();

  /// How far the contact came.
  const InterfaceSolution &solution() const { return solution_.interface; }
  int iterations() const { return seen_.iterations(); }
  Vector3 place(std::size_t point) const { return model_.interface[contact_.node_of(point)].point; }
  /// The rigid motions by which the loads carry the body off, that only its contact holds, with the
  /// contact as it was found; empty: none.
  std::string carried_off() const;
  /// b - K x, or the same cell by cell, in what is free when the step is solved.
  std::vector<double> freed(std::vector<double> residual) const {
    return seen_.freed(std::move(residual));
  }
  /// An estimate of the error of what was found, over the size of the state.
  double forward_error();
  StepOutcome outcome();
  void take_back();

  Eigen::VectorXd accumulated_slip() const { return contact_.accumulated_slip(); }
  void save(output::SavedNumbers &numbers) const;
  void restore(const output::SavedNumbers &numbers);

 private:
  bool settle_contact();
  bool find();
  StateAtNode states() const {
    return [this](std::size_t node) { return contact_.state_for_exchange(node, solution_); };
  }
  CoupledContact coupled() { return {seen_, contact_.points(), contact_.couplings()}; }
  bool is_lost() const { return !solution_.interface.converged || !carried_off().empty(); }
  bool is_balanced(const InterfaceSolution &found) const;
  bool is_in_doubt() const;
  bool find_fast();
  bool newton_step(const ContactTangent &tangent, std::vector<double> residual);
  CoupledSolution solve_from(const Eigen::VectorXd &start,
                             int in_all = std::numeric_limits<int>::max());
  using Begin = std::function<void()>;  // goes back to the state that is predicted
  void find_safely(const Eigen::VectorXd &start, const Begin &begin);
  void find_by_solutions(const Eigen::VectorXd &start);
  bool find_by_matrix(const Eigen::VectorXd &start, const Begin &begin);
  std::optional<Eigen::MatrixXd> made_matrix();
  bool settle_by_matrix(const Eigen::VectorXd &start);
  CoupledSolution solved_by_matrix(const Eigen::VectorXd &loads, const Eigen::VectorXd &start);
  bool is_without_points() const { return contact_.points().empty(); }

  const Model<dim> &model_;
  BodyEquations<dim> &body_;
  RouteReport &count_;
  const bool is_leaning_;
  const double tolerance_;
  const Route::Listener say_;
  ContactNodes<dim> contact_;
  HeldExchanges<dim> exchange_;
  BodyBySolutions<dim> seen_;              // by the contact
  std::optional<Eigen::MatrixXd> matrix_;  // A, once it was needed
  bool has_no_matrix_ = false;             // some column could not be solved
  // Of the step at hand:
  std::span<double> state_;
  double time_ = 0;
  CoupledSolution solution_;
  bool is_found_safely_ = false, needed_safe_stage_ = false;
  bool drifts_ = false;  // by its matrix the loads carry the body off
};

}  // namespace tourmaline::solve
