#pragma once

#include <array>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "krylov/body_system.h"
#include "output/checkpoint.h"
#include "solve/held_exchanges.h"
#include "solve/model.h"
#include "solve/route.h"

namespace tourmaline::solve {

/// The body's equations K x = b in a step of the iterative route: what the state leaves of them,
/// whether that is little enough, and corrections of the state by preconditioned Krylov iteration
/// (`krylov::BodySystem`). Once refined, products with K are taken cell by cell, and corrections go
/// on until they fall no more.
///
/// All vectors have an entry for each unknown of this rank (SI). A free residual is b - K x less
/// the friction of slipping points, projected onto what contact and prescribed unknowns leave free.
template <int dim>
class BodyEquations {
 public:
  /// All outlive the equations. What the iterations take is added to `count`.
  BodyEquations(const Model<dim> &model, const std::vector<bool> &is_prescribed,
                RouteReport &count);

  /// Another right-hand side b, and the state x that `correct` changes from now on.
  void begin_step(std::span<const double> right_side, std::span<double> state);
  /// From now on K and b are those with what crosses the contact held as it is here.
  void hold(const HeldExchanges<dim> &exchange);

  /// b as the step began.
  std::span<const double> loads() const { return loads_; }
  /// Looks at the state anew.
  void update_residual();
  /// b - K x; at contact nodes the force [N] that the contact bears.
  const std::vector<double> &residual() const { return residual_; }
  /// The same with the products cell by cell.
  std::vector<double> residual_by_cells() const;

  /// The largest of the forces [N] that each field of the state exerts on a node by itself, those
  /// at supports among them; and what round-off of the state may make of a node's force.
  struct NodalForces {
    double largest = 0, round_off = 0;
  };
  NodalForces nodal_forces() const;
  /// The same of the state with which the step began. All others are summed from it and
  /// corrections, so its round-off stays in them.
  const NodalForces &first_nodal_forces() const { return first_nodal_forces_; }

  /// Whether the free residual is within solver.linear_tolerance in each field or, where an
  /// iteration gains little, within round-off. Refined equations are solved when corrections do not
  /// fall any more.
  bool is_solved(std::span<const double> free_residual);
  /// The free residual seen last over what is allowed, in the worst field; 1 or less: solved.
  double lack() const { return lack_; }
  /// What was seen of residuals and corrections says nothing of those that follow.
  void begin_corrections();

  /// Solves the linear system, its residual taken down by `reduction`. False where the iteration
  /// did not come as far.
  bool solve(std::span<const double> free_residual, double reduction);
  /// What it has found.
  const std::vector<double> &increment() const { return increment_; }
  /// The same, and adds it to the state.
  bool correct(std::span<const double> free_residual, double reduction);
  /// Corrects the state until all that is free beside the contact, which is `held`, is solved;
  /// throws SolveError where that does not succeed.
  void solve_held(double time, const std::vector<krylov::NodeTangent<dim>> &held);
  void forget_increment();

  /// Goes on with products cell by cell.
  void refine();
  bool is_refined() const { return system_.is_refined(); }
  /// An estimate of the state's forward error by the free residual cell by cell: the size of what
  /// the iteration answers to it, over the state; infinite where it does not converge.
  double forward_error(std::span<const double> free_residual);
  /// The size of the last correction over the state.
  double last_correction() const { return correction_; }
  double backward_error(std::span<const double> free_residual) const;

  krylov::BodySystem<dim> &system() { return system_; }
  const krylov::BodySystem<dim> &system() const { return system_; }

 private:
  [[noreturn]] void give_up(double time, std::span<const double> free_residual) const;
  std::vector<double> left(std::vector<double> product) const;
  bool corrections_go_on() const;
  std::array<double, 3> field_sizes() const;
  std::array<double, 3> round_off(std::span<const double> right_side) const;

  const Model<dim> &model_;
  const std::vector<bool> &is_prescribed_;
  RouteReport &count_;
  krylov::BodySystem<dim> system_;
  std::vector<double> residual_, increment_;
  std::vector<std::pair<std::size_t, double>> slopes_;  // by unknown: of what crosses
  // Of the step at hand:
  std::span<const double> loads_;
  std::vector<double> right_side_;
  std::span<double> state_;
  NodalForces first_nodal_forces_;
  std::array<double, 3> first_round_off_{};
  double lack_ = 0;
  double correction_ = 0;
  bool corrections_fall_ = true;
};

}  // namespace tourmaline::solve
