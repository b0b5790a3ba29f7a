#pragma once

namespace tourmaline::run {

/// While it lives, the first SIGHUP, SIGINT or SIGTERM only leaves a note, so that a run can end
/// between two steps; the second one ends the process at once. One at a time.
class StopSignals {
 public:
  StopSignals();
  StopSignals(const StopSignals &) = delete;
  StopSignals &operator=(const StopSignals &) = delete;
  ~StopSignals();

  /// From now on the first signal is answered with this text on stderr, at once.
  void answer(const char *text);

  /// The signal that came; 0: none.
  int received() const;
};

/// "SIGHUP", "SIGINT" or "SIGTERM".
const char *signal_name(int signal);

}  // namespace tourmaline::run
