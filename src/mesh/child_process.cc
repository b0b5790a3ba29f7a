#include "child_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstring>
#include <ctime>
#include <fstream>
#include <new>
#include <optional>
#include <stdexcept>

#include "tourmaline/error.h"

namespace tourmaline::mesh {

namespace {

// The first byte of what the child sends.
enum Outcome : char { done = 'd', wrong_case = 'c', machine_failed = 'm', no_memory = 'n' };

// The child's end of the pipe.
constexpr int pipe_of_child = STDERR_FILENO + 1;

std::string outcome_of(const std::function<std::string()> &work) {
  try {
    return std::string(1, done) + work();
  } catch (const CaseError &error) {
    return std::string(1, wrong_case) + error.what();
  } catch (const MachineError &error) {
    return std::string(1, machine_failed) + error.what();
  } catch (const std::bad_alloc &) {
    return std::string(1, no_memory);
  } catch (const std::length_error &) {
    return std::string(1, no_memory);
  }
}

void send(const std::string &text) {
  for (std::size_t sent = 0; sent < text.size();) {
    const ssize_t n = write(pipe_of_child, text.data() + sent, text.size() - sent);
    if (n < 0 && errno != EINTR)
      return;
    sent += static_cast<std::size_t>(std::max<ssize_t>(n, 0));
  }
}

double address_space() {
  double pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<double>(sysconf(_SC_PAGESIZE));
}

// Beyond the soft limit of time comes SIGXCPU, beyond the hard one SIGKILL. What the user has
// limited already stays so.
void limit(decltype(RLIMIT_CPU) resource, double most) {
  rlimit now{};
  if (!std::isfinite(most) || getrlimit(resource, &now) != 0)
    return;
  const auto soft = static_cast<rlim_t>(most);
  const rlimit both{std::min(soft, now.rlim_cur),
                    std::min(resource == RLIMIT_CPU ? soft + 1 : soft, now.rlim_max)};
  setrlimit(resource, &both);
}

// What a library prints while it breaks is no message for anybody.
void keep_only(int pipe) {
  const int aside = fcntl(pipe, F_DUPFD, pipe_of_child + 1);
  if (const int nothing = open("/dev/null", O_RDWR); nothing >= 0)
    for (const int standard : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
      dup2(nothing, standard);
  dup3(aside, pipe_of_child, O_CLOEXEC);  // programs that a child starts do not hold it
  close_range(pipe_of_child + 1, ~0U, 0);
}

// An exception that nobody expected ends the child: beyond here stands what the parent goes on
// with.
[[noreturn]] void be_child(int pipe, pid_t parent, const std::function<std::string()> &work,
                           const Limits &limits) noexcept {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent)
    _exit(1);
  keep_only(pipe);
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, std::ceil(limits.processor_seconds));
  limit(RLIMIT_AS, address_space() + limits.bytes);
  for (const int signal : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL, SIGSYS, SIGINT, SIGTERM})
    std::signal(signal, SIG_DFL);
  send(outcome_of(work));
  _exit(0);
}

/// The child as its parent sees it.
class Child {
 public:
  explicit Child(pid_t id) : id_(id) {}
  ~Child() {
    if (!ended_)
      kill();
  }
  Child(const Child &) = delete;
  Child &operator=(const Child &) = delete;

  bool has_ended() { return ended_ || (ended_ = waitpid(id_, &status_, WNOHANG) == id_); }
  /// Waits for the end.
  int status() {
    while (!ended_)
      ended_ = waitpid(id_, &status_, 0) == id_ || errno != EINTR;
    return status_;
  }
  void kill(std::optional<Ending> why = {}) {
    ::kill(id_, SIGKILL);
    status();
    killed_ = why;
  }
  /// Why, if it was killed before its end.
  std::optional<Ending> killed() const { return killed_; }
  double processor_seconds() const {
    clockid_t clock;
    timespec used{};
    if (clock_getcpuclockid(id_, &clock) == 0)
      clock_gettime(clock, &used);
    return static_cast<double>(used.tv_sec) + 1e-9 * static_cast<double>(used.tv_nsec);
  }

 private:
  pid_t id_;
  std::optional<Ending> killed_;
  int status_ = 0;
  bool ended_ = false;
};

/// The limits by the clock.
class Watch {
 public:
  Watch(const Child &child, const Limits &limits) : child_(child), limits_(limits) {}

  /// Which of them the child is beyond.
  std::optional<Ending> beyond() {
    if (const double used = child_.processor_seconds(); used > used_) {
      used_ = used;
      worked_ = Clock::now();
    }
    if (since(worked_) > limits_.idle_seconds)
      return Ending::waiting;
    return since(start_) > limits_.seconds ? std::optional(Ending::out_of_time) : std::nullopt;
  }

 private:
  using Clock = std::chrono::steady_clock;
  static double since(Clock::time_point then) {
    return std::chrono::duration<double>(Clock::now() - then).count();
  }

  const Child &child_;
  const Limits &limits_;
  const Clock::time_point start_ = Clock::now();
  Clock::time_point worked_ = start_;
  double used_ = 0;
};

/// What the child sends until its end, or until a limit, when it is killed. Whoever else holds the
/// pipe then is not waited for.
std::string received(int pipe, Child &child, const Limits &limits) {
  Watch watch(child, limits);
  std::string text;
  std::string part(1 << 16, '\0');
  pollfd wanted{pipe, POLLIN, 0};
  for (bool ended = false;;) {
    const int ready = poll(&wanted, 1, ended ? 0 : 200);
    if (ready > 0) {
      const ssize_t n = read(pipe, part.data(), part.size());
      if (n == 0 || (n < 0 && errno != EINTR))
        return text;
      text.append(part, 0, static_cast<std::size_t>(std::max<ssize_t>(n, 0)));
    } else if (ended) {
      return text;
    } else {
      ended = child.has_ended();
    }
    if (const std::optional<Ending> ending = ended ? std::nullopt : watch.beyond())
      child.kill(ending);
  }
}

// Empty if it has worked to its end.
std::optional<Ending> ending_of(Child &child) {
  const int status = child.status();
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0)
    return {};
  if (child.killed())
    return child.killed();
  const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  if (signal == SIGXCPU)
    return Ending::out_of_time;
  if (signal == SIGKILL)  // by the kernel, which has no memory left
    return Ending::out_of_memory;
  return signal == SIGSYS ? Ending::forbidden : Ending::crashed;
}

/// Both ends of a pipe that no started program gets.
class Pipe {
 public:
  Pipe() {
    if (pipe2(ends_, O_CLOEXEC) != 0)
      throw MachineError(fmt::format("no pipe can be opened: {}", std::strerror(errno)));
  }
  ~Pipe() {
    close_writing();
    close(ends_[0]);
  }
  Pipe(const Pipe &) = delete;
  Pipe &operator=(const Pipe &) = delete;

  int reading() const { return ends_[0]; }
  int writing() const { return ends_[1]; }
  void close_writing() {
    if (ends_[1] >= 0)
      close(ends_[1]);
    ends_[1] = -1;
  }

 private:
  int ends_[2] = {-1, -1};
};

}  // namespace

std::string in_child_process(const std::function<std::string()> &work, const Limits &limits,
                             const std::function<std::string(Ending)> &complaint) {
  Pipe pipe;
  const pid_t parent = getpid();
  const pid_t id = fork();
  if (id < 0)
    throw MachineError(fmt::format("no process can be started: {}", std::strerror(errno)));
  if (id == 0)
    be_child(pipe.writing(), parent, work, limits);
  pipe.close_writing();
  Child child(id);
  const std::string text = received(pipe.reading(), child, limits);
  if (const std::optional<Ending> ending = ending_of(child))
    throw CaseError(complaint(*ending));
  if (text.empty())
    throw CaseError(complaint(Ending::silent));
  if (text[0] == no_memory)
    throw CaseError(complaint(Ending::out_of_memory));
  if (text[0] == wrong_case)
    throw CaseError(text.substr(1));
  if (text[0] == machine_failed)
    throw MachineError(text.substr(1));
  return text.substr(1);
}

}  // namespace tourmaline::mesh
