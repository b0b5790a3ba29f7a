#pragma once

#include <chrono>
#include <string>

#include "output/records.h"
#include "output/status_line.h"

namespace tourmaline::output {

/// What the progress line says after a step; `steps` of all is left out when it is 0 (not known),
/// `seconds_left` when it is negative (not known yet).
std::string progress_text(const HistoryRow &row, int steps, double seconds_left);

/// Says on stderr how far a run is: on a terminal in one line with a bar that is rewritten in
/// place, elsewhere (a pipe, a log) in a line of its own every `pause`, so that a short run says
/// nothing. Says nothing when `quiet`. Never throws for what the terminal does.
class Progress {
 public:
  /// `steps` is 0 where nobody knows how many there will be before the time `end` [s].
  Progress(int steps, double end, bool quiet,
           std::chrono::milliseconds pause = std::chrono::seconds(5));
  Progress(const Progress &) = delete;
  Progress &operator=(const Progress &) = delete;
  ~Progress() { done(); }

  /// Names the work that goes on until the next call ("mesh", "factorise"); drawn at once.
  void stage(const std::string &what);

  /// Reports work within a step, of which so much is done; drawn as often as steps.
  void part(const std::string &what, int done, int all);

  /// There are so many steps after all.
  void expect(int steps) { steps_ = steps; }
  /// Reports a finished step; drawn at most ten times a second.
  void step(const HistoryRow &row);

  /// Clears the line, so that other text can follow. Idempotent; a later call draws it again.
  void done();

 private:
  using Clock = std::chrono::steady_clock;

  double seconds_left(double share, Clock::time_point now) const;
  bool due() const { return line_.since_last() >= pause_; }

  int steps_;
  double end_;
  bool quiet_;
  StatusLine line_;
  std::chrono::milliseconds pause_;  // between two drawings
  bool started_ = false;             // whether a step has been reported
  double first_share_ = 0;           // of the whole, done by then
  Clock::time_point first_step_end_;
};

}  // namespace tourmaline::output
