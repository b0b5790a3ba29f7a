#pragma once

#include <chrono>
#include <string>

#include "tourmaline/output/records.h"

namespace tourmaline::output {

/// What the progress line says after a step; `seconds_left` is left out when it is negative (not
/// known yet).
std::string progress_text(const HistoryRow &row, int steps, double seconds_left);

/// A line on the terminal that says how far a run is, rewritten in place. Says nothing when `quiet`
/// or when stderr is not a terminal. Never throws for what the terminal does.
class Progress {
 public:
  Progress(int steps, bool quiet);
  Progress(const Progress &) = delete;
  Progress &operator=(const Progress &) = delete;
  ~Progress() { done(); }

  /// Names the work that goes on until the next call ("mesh", "factorise"); drawn at once.
  void stage(const std::string &what);

  /// Reports a finished step; drawn at most ten times a second.
  void step(const HistoryRow &row);

  /// Clears the line, so that other text can follow. Idempotent; a later call draws it again.
  void done();

 private:
  using Clock = std::chrono::steady_clock;

  double seconds_left(int step, Clock::time_point now) const;
  void draw(const std::string &text);

  int steps_;
  bool shown_;            // whether there is a terminal to draw on
  bool drawn_ = false;    // whether the line holds text
  bool started_ = false;  // whether a step has been reported
  int first_step_ = 0;
  Clock::time_point first_step_end_, last_draw_;
};

}  // namespace tourmaline::output
