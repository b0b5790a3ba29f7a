#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "output/checkpoint.h"
#include "output/progress.h"
#include "run/chosen_route.h"
#include "solve/balance_step.h"
#include "solve/electrode_search.h"
#include "solve/foundation_circuits.h"
#include "solve/leaked_charge.h"
#include "solve/model.h"
#include "solve/motion.h"
#include "solve/steady_heat.h"

namespace tourmaline::run {

/// A step that has been computed, and not been written yet.
struct TakenStep {
  int n = 0;
  std::vector<double> before, state;  ///< the unknowns at its beginning and end
  std::vector<double> loads, right_side;
  solve::StepOutcome outcome;
  double seconds = 0;
};

/// The body and all that its next step depends on. All ranks do the same.
template <int dim>
class Evolution {
 public:
  /// In the initial state. `model` outlives this; its circuits and step are set from here.
  explicit Evolution(solve::Model<dim> &model);
  Evolution(const Evolution &) = delete;

  /// Factorises; before the first step, for which the initial state is settled. As ChosenRoute.
  void make_ready(bool iterative, output::Progress &progress, int first);
  /// To where the first step can start from.
  void begin();

  /// Step n, the next one, as the model's steps have it; the step after it goes on from there.
  /// Throws SolveError, CaseError, MachineError.
  TakenStep take(int n);
  /// The balances of step n, which have made the products that the step after it remembers.
  void see_balanced(int n, const solve::BalancedState<dim> &end);

  /// What the next step remembers of the state before it: heats, zero at other unknowns.
  struct Remembered {
    std::vector<double> heats;  ///< by unknown; empty: not computed yet
    bool by_cells = false;      ///< from products cell by cell
  };

  /// All that steps from here depend on.
  struct Point {
    std::vector<double> state;
    Remembered remembered;
    output::SavedNumbers rest;
    typename ChosenRoute<dim>::Memory route;
  };
  Point point() const;
  /// Makes step n the next one, of whatever size, from a point that was there: the same bits follow
  /// whatever was done meanwhile.
  void go_back(const Point &point, int n);

  const std::vector<double> &state() const { return state_; }
  const solve::Motion<dim> &motion() const { return motion_; }
  ChosenRoute<dim> &route() { return *route_; }
  const ChosenRoute<dim> &route() const { return *route_; }

  void save(output::SavedNumbers &numbers) const;
  void restore(const output::SavedNumbers &numbers);

 private:
  void settle(bool iterative);
  void prescribe(double time, std::vector<double> &state);
  void sum_right_side(TakenStep &step);
  void add_remembered(std::vector<double> &right_side);
  void remember(const body::FieldProducts &products, bool by_cells);
  void advance(TakenStep &step);

  solve::Model<dim> &model_;
  solve::LeakedCharge<dim> leaked_;  // by the last step
  solve::Motion<dim> motion_;        // of that step
  solve::FoundationCircuits<dim> foundations_;
  std::vector<double> state_;
  Remembered remembered_;  // of state_
  int last_ = 0;           // the step that state_ is the end of, if a step has been taken
  std::optional<solve::SteadyHeat<dim>> steady_heat_;  // of a static case with temperatures
  std::optional<ChosenRoute<dim>> route_;
  std::optional<solve::ElectrodeSearch<dim>> electrodes_;  // where the route does not find them
};

}  // namespace tourmaline::run
