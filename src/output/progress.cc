#include "tourmaline/output/progress.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cmath>
#include <string_view>

namespace tourmaline::output {
namespace {

constexpr std::chrono::milliseconds redraw_interval(100);
constexpr std::string_view clear_line = "\r\033[K";

/// A line that wrapped could not be rewritten in place.
std::size_t terminal_width() {
  winsize size{};
  const bool known = ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return known ? size.ws_col : 80;
}

/// Progress is a courtesy: a terminal that has gone away must not stop a run.
void put(std::string_view text) {
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, text.data(), text.size());
}

std::string duration(double seconds) {
  const long whole = std::lround(seconds);
  if (whole < 60)
    return fmt::format("{} s", whole);
  if (whole < 3600)
    return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole / 60 % 60);
}

}  // namespace

std::string progress_text(const HistoryRow &row, int steps, double seconds_left) {
  std::string text = fmt::format("step {}/{}  t = {:.4g} s  Newton {}  stick {}  slip {}", row.step,
                                 steps, row.time, row.newton_iterations, row.stick, row.slip);
  if (seconds_left >= 0)
    text += fmt::format("  {} left", duration(seconds_left));
  return text;
}

Progress::Progress(int steps, bool quiet)
    : steps_(steps), shown_(!quiet && ::isatty(STDERR_FILENO)) {}

void Progress::stage(const std::string &what) {
  if (shown_)
    draw(what + " ...");
}

void Progress::step(const HistoryRow &row) {
  if (!shown_)
    return;
  const Clock::time_point now = Clock::now();
  if (!started_) {
    started_ = true;
    first_step_ = row.step;
    first_step_end_ = now;
  } else if (now - last_draw_ < redraw_interval) {
    return;
  }
  last_draw_ = now;
  draw(progress_text(row, steps_, seconds_left(row.step, now)));
}

double Progress::seconds_left(int step, Clock::time_point now) const {
  if (step <= first_step_)
    return -1;  // One end of a step gives no duration; the first step may also carry set-up.
  const std::chrono::duration<double> passed = now - first_step_end_;
  return passed.count() / (step - first_step_) * (steps_ - step);
}

void Progress::draw(const std::string &text) {
  put(std::string(clear_line) + text.substr(0, terminal_width() - 1));
  drawn_ = true;
}

void Progress::done() {
  if (drawn_)
    put(clear_line);
  drawn_ = false;
}

}  // namespace tourmaline::output
