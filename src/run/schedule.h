#pragma once

#include <chrono>

#include "case/interval.h"
#include "case/time_steps.h"
#include "run/stop_signals.h"
#include "tourmaline/case/case.h"

namespace tourmaline::run {

/// Whether a run of the case writes fields behind step n of these; 0 is the beginning.
bool writes_fields(const casefile::Case &asked, const casefile::TimeSteps &steps, int n);

/// What a run does between two steps besides going on. All ranks ask together and get the same
/// answer.
class Schedule {
 public:
  struct Pause {
    bool saves = false;  ///< a checkpoint
    int stopped_by = 0;  ///< the signal that ends the run here, 0: none; it saves one too
  };

  explicit Schedule(const casefile::Interval &interval) : interval_(interval) {}

  /// Behind the steps `first` to `last`, between which nothing pauses.
  Pause after(int first, int last);

  /// As StopSignals has them: behind the last step nothing pauses any more.
  void answer(const char *text) { signals_.answer(text); }
  int received() const { return signals_.received(); }

 private:
  using Clock = std::chrono::steady_clock;

  bool is_due(int first, int last) const;

  StopSignals signals_;
  casefile::Interval interval_;
  Clock::time_point last_ = Clock::now();  // when the last checkpoint was saved
};

}  // namespace tourmaline::run
