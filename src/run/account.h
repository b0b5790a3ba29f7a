#pragma once

#include <array>
#include <string>

#include "output/checkpoint.h"
#include "output/summary.h"
#include "solve/route.h"

namespace tourmaline::run {

/// What a run's steps have taken so far, those of earlier processes that it goes on from included.
class Account {
 public:
  Account();

  /// Of step n, which took that long.
  void step(int n, const solve::StepOutcome &outcome, double seconds);

  /// Iterations, times, memory and the route's own figures, into those entries of a summary.
  /// Collective.
  void put(const solve::RouteReport &report, int steps, output::Summary &summary) const;

  /// A warning of slip that jumped; empty where none did.
  std::string jump_warning(bool is_dynamic) const;

  void save(output::SavedNumbers &numbers) const;
  void restore(const output::SavedNumbers &numbers);

 private:
  std::string steps_with_jumps() const;
  void put_iterations(const solve::RouteReport &report, output::Summary &summary) const;

  double start_;         // seconds of this process before it made an account
  double before_ = 0;    // seconds of the processes that it goes on from
  double in_steps_ = 0;  // seconds
  int newton_total_ = 0, newton_max_ = 0, newton_first_ = 0;
  int slip_jumps_ = 0, first_slip_jump_ = 0;  // steps with one, and the first of them
  // Steps by the stage that has found their contact, where friction depends on the pressure.
  std::array<double, solve::n_contact_stages> stages_{};
};

}  // namespace tourmaline::run
