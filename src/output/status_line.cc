#include "output/status_line.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <string_view>

namespace tourmaline::output {
namespace {

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

}  // namespace

std::string duration_text(double seconds) {
  const long whole = std::lround(seconds);
  if (whole < 60)
    return fmt::format("{} s", whole);
  if (whole < 3600)
    return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole / 60 % 60);
}

std::string progress_bar(int done, int all, std::size_t width) {
  const std::size_t inside = width - 2;
  const std::size_t full = all > 0 ? inside * static_cast<std::size_t>(done) / all : 0;
  return "[" + std::string(full, '#') + std::string(inside - full, '-') + "]";
}

StatusLine::StatusLine() : terminal_(::isatty(STDERR_FILENO)), last_draw_(Clock::now()) {}

void StatusLine::draw(const std::string &text) {
  last_draw_ = Clock::now();
  if (!terminal_)
    return put(text + "\n");
  put(std::string(clear_line) + text.substr(0, terminal_width() - 1));
  drawn_ = true;
}

void StatusLine::draw(const std::string &text, int done, int all) {
  if (!terminal_ || terminal_width() <= text.size() + narrowest_bar + 1)
    return draw(text);
  const std::size_t width = std::min(widest_bar, terminal_width() - text.size() - 2);
  draw(progress_bar(done, all, width) + " " + text);
}

void StatusLine::clear() {
  if (drawn_)
    put(clear_line);
  drawn_ = false;
}

}  // namespace tourmaline::output
