#include "output/progress.h"

#include <fmt/format.h>

namespace tourmaline::output {
namespace {

constexpr std::chrono::milliseconds redraw_interval(100);

}  // namespace

std::string progress_text(const HistoryRow &row, int steps, double seconds_left) {
  std::string text = fmt::format("step {}/{}  t = {:.4g} s  Newton {}  stick {}  slip {}", row.step,
                                 steps, row.time, row.newton_iterations, row.stick, row.slip);
  if (seconds_left >= 0)
    text += fmt::format("  {} left", duration_text(seconds_left));
  return text;
}

Progress::Progress(int steps, bool quiet, std::chrono::milliseconds pause)
    : steps_(steps), quiet_(quiet), pause_(line_.is_terminal() ? redraw_interval : pause) {}

void Progress::stage(const std::string &what) {
  if (!quiet_ && (line_.is_terminal() || due()))
    line_.draw(what + " ...");
}

void Progress::step(const HistoryRow &row) {
  if (quiet_)
    return;
  const Clock::time_point now = Clock::now();
  const bool first = !started_;
  if (first) {
    started_ = true;
    first_step_ = row.step;
    first_step_end_ = now;
  }
  if (due() || (first && line_.is_terminal()))
    line_.draw(progress_text(row, steps_, seconds_left(row.step, now)), row.step, steps_);
}

double Progress::seconds_left(int step, Clock::time_point now) const {
  if (step <= first_step_)
    return -1;  // One end of a step gives no duration; the first step may also carry set-up.
  const std::chrono::duration<double> passed = now - first_step_end_;
  return passed.count() / (step - first_step_) * (steps_ - step);
}

void Progress::done() {
  line_.clear();
}

}  // namespace tourmaline::output
