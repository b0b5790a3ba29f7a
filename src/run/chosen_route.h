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
/// to a factorisation from an iterative solution that fails.
template <int dim>
class ChosenRoute {
 public:
  /// Makes it ready: factorises or makes a preconditioner. `iterative` was decided before the model
  /// took its memory. Throws CaseError, SolveError, MachineError.
  ChosenRoute(const solve::Model<dim> &model, bool iterative, output::Progress &progress);

  /// Step n, as `Route::advance` from `state` to `next`.
  solve::StepOutcome advance(int n, std::span<const double> right_side,
                             std::span<const double> state, std::span<double> next);

  solve::Route &route() { return *route_; }
  const solve::Route &route() const { return *route_; }
  /// What `solver.body = "automatic"` did that the user may not expect.
  std::vector<std::string> warnings() const;

  void save(output::SavedNumbers &numbers) const;
  void restore(const output::SavedNumbers &numbers);
  /// Whether the run that saved these numbers was solved iteratively.
  static bool was_iterative(const output::SavedNumbers &numbers);

 private:
  void factorise_after_all(int n, const SolveError &error);

  const solve::Model<dim> &model_;
  output::Progress &progress_;
  bool iterative_;
  int direct_from_ = 0;  // the step from which on it is not, after all
  std::unique_ptr<solve::Route> route_;
};

}  // namespace tourmaline::run
