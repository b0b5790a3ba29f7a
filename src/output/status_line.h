#pragma once

#include <chrono>
#include <cstddef>
#include <string>

namespace tourmaline::output {

/// `done` of `all` as a bar of that many characters with its ends: "[####----]".
std::string progress_bar(int done, int all, std::size_t width);

/// "42 s", "3 min 07 s", "2 h 15 min".
std::string duration_text(double seconds);

/// The line on stderr that says how far a work is: on a terminal it is rewritten in place,
/// elsewhere (a pipe, a log) each text is a line of its own. Never throws for what the terminal
/// does.
class StatusLine {
 public:
  StatusLine();
  StatusLine(const StatusLine &) = delete;
  StatusLine &operator=(const StatusLine &) = delete;
  ~StatusLine() { clear(); }

  bool is_terminal() const { return terminal_; }
  std::chrono::duration<double> since_last() const { return Clock::now() - last_draw_; }

  void draw(const std::string &text);
  /// With a bar before the text where there is room for one.
  void draw(const std::string &text, int done, int all);
  /// Makes room for other text. Idempotent.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;

  bool terminal_;
  bool drawn_ = false;  // whether the line holds text
  Clock::time_point last_draw_;
};

}  // namespace tourmaline::output
