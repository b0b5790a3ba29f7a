#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "output/checkpoint.h"
#include "output/progress.h"
#include "solve/model.h"
#include "solve/route.h"
#include "tourmaline/error.h"

namespace tourmaline::run {

/// The route that solves a run's steps, by the case and the memory that is there, and the way back
/// to a factorisation from an iterative solution that fails. Each size of steps has a route of its
/// own, which goes on from the one before. Factorised bodies of sizes that have been are kept as
/// long as another one fits beside them, the oldest goes first; results do not depend on it.
template <int dim>
class ChosenRoute {
 public:
  /// Makes it ready: factorises or makes a preconditioner. `iterative` was decided before the model
  /// took its memory; `model` is one of step `first`. Throws CaseError, SolveError, MachineError.
  ChosenRoute(solve::Model<dim> &model, bool iterative, output::Progress &progress, int first = 1);

  /// Makes model and route those of step n.
  void begin_step(int n);
  /// Of the steps so far, for later.
  struct Memory {
    bool iterative = false;
    Eigen::VectorXd accumulated_slip;
    solve::Route::Memory of_route;
  };
  Memory memory() const;
  /// Likewise, and forgets what was done since then.
  void begin_step(int n, const Memory &from);
  /// Step n, as `Route::advance` from `state` to `next`.
  solve::StepOutcome advance(int n, std::span<const double> right_side,
                             std::span<const double> state, std::span<double> next);

  solve::Route &route() { return *route_; }
  const solve::Route &route() const { return *route_; }
  /// Of steps of so many sizes.
  solve::RouteReport report(int sizes) const;
  /// What `solver.body = "automatic"` did that the user may not expect.
  std::vector<std::string> warnings() const;

  void save(output::SavedNumbers &numbers) const;
  void restore(const output::SavedNumbers &numbers);
  /// Whether the run that saved these numbers was solved iteratively.
  static bool was_iterative(const output::SavedNumbers &numbers);

 private:
  void factorise_after_all(int n, const SolveError &error);
  std::unique_ptr<solve::Route> made_route();
  std::unique_ptr<solve::Route> kept_of(double step);
  void take_size(double step);
  void make_room();
  bool is_factorised() const { return !iterative_ && model_.asked.solver.method == "condensed"; }

  struct Kept {
    double step;  // [s]
    std::unique_ptr<solve::Route> route;
  };

  solve::Model<dim> &model_;
  output::Progress &progress_;
  bool iterative_;
  int direct_from_ = 0;  // the step from which on it is not, after all
  std::unique_ptr<solve::Route> route_;
  std::vector<Kept> kept_;  // of other sizes of steps, the one that was needed last behind
};

}  // namespace tourmaline::run
