#include "run/stop_signals.h"

#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <iterator>

namespace tourmaline::run {

namespace {

constexpr int stopping[] = {SIGINT, SIGTERM, SIGHUP};
volatile std::sig_atomic_t noted = 0;
std::atomic<const char *> answer_text = nullptr;  // free of locks, so that a handler may read it
struct sigaction previous[std::size(stopping)];

void restore() {
  for (std::size_t i = 0; i < std::size(stopping); ++i)
    sigaction(stopping[i], &previous[i], nullptr);
}

// The second signal, of either kind, meets what stood there before: the end.
void note(int signal) {
  const int error_number = errno;
  noted = signal;
  restore();
  if (const char *text = answer_text) [[maybe_unused]]
    const ssize_t written = ::write(STDERR_FILENO, text, std::strlen(text));
  errno = error_number;
}

}  // namespace

StopSignals::StopSignals() {
  noted = 0;
  answer_text = nullptr;
  struct sigaction action {};
  action.sa_handler = note;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  for (const int signal : stopping)
    sigaddset(&action.sa_mask, signal);
  for (std::size_t i = 0; i < std::size(stopping); ++i) {
    sigaction(stopping[i], nullptr, &previous[i]);
    // Shells have the background jobs of a script ignore SIGINT, and nohup SIGHUP; so they stay
    // ignored.
    if (previous[i].sa_handler != SIG_IGN)
      sigaction(stopping[i], &action, nullptr);
  }
}

StopSignals::~StopSignals() {
  restore();
}

void StopSignals::answer(const char *text) {
  answer_text = text;
}

int StopSignals::received() const {
  return noted;
}

const char *signal_name(int signal) {
  return signal == SIGINT ? "SIGINT" : signal == SIGTERM ? "SIGTERM" : "SIGHUP";
}

}  // namespace tourmaline::run
