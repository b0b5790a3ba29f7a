#include "sweep/processes.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <iterator>
#include <string>
#include <utility>

#include "tourmaline/error.h"

namespace tourmaline::sweep {

namespace {

constexpr int heard[] = {SIGCHLD, SIGINT, SIGTERM, SIGHUP};
struct sigaction previous[std::size(heard)];
volatile std::sig_atomic_t noted = 0;
int wake[2] = {-1, -1};  // a pipe, so that poll() wakes for a signal that came just before it

void note(int signal) {
  const int error_number = errno;
  if (signal != SIGCHLD)
    noted = signal;
  [[maybe_unused]] const ssize_t written = ::write(wake[1], "", 1);
  errno = error_number;
}

void hear_as_before() {
  for (std::size_t i = 0; i < std::size(heard); ++i)
    sigaction(heard[i], &previous[i], nullptr);
}

// Signals wait while there is one: a copy would note what it hears where nobody looks.
class Deaf {
 public:
  Deaf() {
    sigset_t all;
    sigemptyset(&all);
    for (const int signal : heard)
      sigaddset(&all, signal);
    sigprocmask(SIG_BLOCK, &all, &before_);
  }
  ~Deaf() { hear(); }
  Deaf(const Deaf &) = delete;
  Deaf &operator=(const Deaf &) = delete;

  void hear() const { sigprocmask(SIG_SETMASK, &before_, nullptr); }

 private:
  sigset_t before_;
};

[[noreturn]] void become(const Processes::Work &work, int log, pid_t parent, const Deaf &deaf) {
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);
  hear_as_before();
  deaf.hear();
  const int nothing = ::open("/dev/null", O_RDONLY);
  if (::getppid() != parent || ::dup2(nothing, STDIN_FILENO) < 0 ||
      ::dup2(log, STDOUT_FILENO) < 0 || ::dup2(log, STDERR_FILENO) < 0)
    ::_exit(127);
  ::closefrom(STDERR_FILENO + 1);
  std::exit(work());
}

}  // namespace

Processes::Processes() {
  if (::pipe2(wake, O_CLOEXEC | O_NONBLOCK) != 0)
    throw MachineError(std::string("cannot make a pipe: ") + std::strerror(errno));
  noted = 0;
  struct sigaction action {};
  action.sa_handler = note;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  for (std::size_t i = 0; i < std::size(heard); ++i) {
    sigaction(heard[i], nullptr, &previous[i]);
    // Shells have the background jobs of a script ignore SIGINT, and nohup SIGHUP; so they stay
    // ignored.
    if (heard[i] == SIGCHLD || previous[i].sa_handler != SIG_IGN)
      sigaction(heard[i], &action, nullptr);
  }
}

Processes::~Processes() {
  send(SIGKILL);
  for (const auto &[id, number] : numbers_)
    ::waitpid(id, nullptr, 0);
  hear_as_before();
  for (int &end : wake)
    ::close(std::exchange(end, -1));
}

void Processes::start(std::size_t number, const Work &work, const std::filesystem::path &log) {
  const int file = ::open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file < 0)
    throw MachineError("cannot write " + log.string() + ": " + std::strerror(errno));
  std::cout.flush();  // or the copy would write it, too
  const Deaf deaf;
  const pid_t parent = ::getpid(), id = ::fork();
  if (id == 0)
    become(work, file, parent, deaf);
  const int error_number = errno;
  ::close(file);
  if (id < 0)
    throw MachineError(std::string("cannot start a process: ") + std::strerror(error_number));
  numbers_[id] = number;
}

std::optional<Processes::End> Processes::ended() {
  for (const auto &[id, number] : numbers_) {
    int status = 0;
    if (::waitpid(id, &status, WNOHANG) != id)
      continue;
    const End end{number, WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status)};
    numbers_.erase(id);
    return end;
  }
  return std::nullopt;
}

std::optional<Processes::End> Processes::wait(std::chrono::milliseconds most) {
  if (const std::optional<End> end = ended())
    return end;
  pollfd input{wake[0], POLLIN, 0};
  ::poll(&input, 1, static_cast<int>(most.count()));
  char dropped[64];
  while (::read(wake[0], dropped, sizeof dropped) > 0) {
  }
  return ended();
}

void Processes::send(int signal) const {
  for (const auto &[id, number] : numbers_)
    ::kill(id, signal);
}

int Processes::take_signal() {
  const int signal = noted;
  noted = 0;
  return signal;
}

}  // namespace tourmaline::sweep
