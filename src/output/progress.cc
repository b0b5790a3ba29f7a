#include "tourmaline/output/progress.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <string_view>

namespace tourmaline::output {
namespace {

constexpr std::chrono::milliseconds redraw_interval(100);
constexpr std::size_t widest_bar = 24, narrowest_bar = 10;
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

std::string progress_bar(int done, int all, std::size_t width) {
  const std::size_t inside = width - 2;
  const std::size_t full = all > 0 ? inside * static_cast<std::size_t>(done) / all : 0;
  return "[" + std::string(full, '#') + std::string(inside - full, '-') + "]";
}

Progress::Progress(int steps, bool quiet, std::chrono::milliseconds pause)
    : steps_(steps),
      quiet_(quiet),
      terminal_(::isatty(STDERR_FILENO)),
      pause_(terminal_ ? redraw_interval : pause),
      last_draw_(Clock::now()) {}

bool Progress::due(Clock::time_point now) const {
  return now - last_draw_ >= pause_;
}

void Progress::stage(const std::string &what) {
  if (!quiet_ && (terminal_ || due(Clock::now())))
    draw(what + " ...");
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
  if (!due(now) && !(first && terminal_))
    return;
  last_draw_ = now;
  std::string text = progress_text(row, steps_, seconds_left(row.step, now));
  if (terminal_ && terminal_width() > text.size() + narrowest_bar + 1)
    text =
        progress_bar(row.step, steps_, std::min(widest_bar, terminal_width() - text.size() - 2)) +
        " " + text;
  draw(text);
}

double Progress::seconds_left(int step, Clock::time_point now) const {
  if (step <= first_step_)
    return -1;  // One end of a step gives no duration; the first step may also carry set-up.
  const std::chrono::duration<double> passed = now - first_step_end_;
  return passed.count() / (step - first_step_) * (steps_ - step);
}

void Progress::draw(const std::string &text) {
  if (!terminal_) {
    put(text + "\n");
    last_draw_ = Clock::now();
    return;
  }
  put(std::string(clear_line) + text.substr(0, terminal_width() - 1));
  drawn_ = true;
}

void Progress::done() {
  if (drawn_)
    put(clear_line);
  drawn_ = false;
}

}  // namespace tourmaline::output
