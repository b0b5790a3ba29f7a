#include "output/progress.h"

#include <fmt/format.h>

namespace tourmaline::output {
namespace {

constexpr std::chrono::milliseconds redraw_interval(100);

}  // namespace

std::string progress_text(const HistoryRow &row, int steps, double seconds_left) {
  std::string text = fmt::format("step {}{}  t = {:.4g} s  Newton {}  stick {}  slip {}", row.step,
                                 steps > 0 ? fmt::format("/{}", steps) : "", row.time,
                                 row.newton_iterations, row.stick, row.slip);
  if (seconds_left >= 0)
    text += fmt::format("  {} left", duration_text(seconds_left));
  return text;
}

Progress::Progress(int steps, double end, bool quiet, std::chrono::milliseconds pause)
    : steps_(steps),
      end_(end),
      quiet_(quiet),
      pause_(line_.is_terminal() ? redraw_interval : pause) {}

void Progress::stage(const std::string &what) {
  if (!quiet_ && (line_.is_terminal() || due()))
    line_.draw(what + " ...");
}

void Progress::step(const HistoryRow &row) {
  if (quiet_)
    return;
  constexpr int all = 10000;
  const double share = steps_ > 0 ? static_cast<double>(row.step) / steps_ : row.time / end_;
  const Clock::time_point now = Clock::now();
  const bool first = !started_;
  if (first) {
    started_ = true;
    first_share_ = share;
    first_step_end_ = now;
  }
  if (due() || (first && line_.is_terminal()))
    line_.draw(progress_text(row, steps_, seconds_left(share, now)), static_cast<int>(all * share),
               all);
}

void Progress::part(const std::string &what, int done, int all) {
  if (!quiet_ && due())
    line_.draw(fmt::format("{}  {}/{}", what, done, all), done, all);
}

double Progress::seconds_left(double share, Clock::time_point now) const {
  if (share <= first_share_)
    return -1;  // One end of a step gives no duration; the first step may also carry set-up.
  const std::chrono::duration<double> passed = now - first_step_end_;
  return passed.count() / (share - first_share_) * (1 - share);
}

void Progress::done() {
  line_.clear();
}

}  // namespace tourmaline::output
