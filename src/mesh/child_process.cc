#include "child_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstring>
#include <new>
#include <stdexcept>

#include "tourmaline/error.h"

namespace tourmaline::mesh {

namespace {

// The first byte of what the child sends.
enum Outcome : char { done = 'd', wrong_case = 'c', machine_failed = 'm' };

std::string outcome_of(const std::function<std::string()> &work) {
  try {
    return std::string(1, done) + work();
  } catch (const CaseError &error) {
    return std::string(1, wrong_case) + error.what();
  } catch (const MachineError &error) {
    return std::string(1, machine_failed) + error.what();
  } catch (const std::bad_alloc &) {
    return std::string(1, wrong_case) + "wants more memory than there is";
  } catch (const std::length_error &) {
    return std::string(1, wrong_case) + "wants more memory than there is";
  }
}

void send(int pipe, const std::string &text) {
  for (std::size_t sent = 0; sent < text.size();) {
    const ssize_t n = write(pipe, text.data() + sent, text.size() - sent);
    if (n < 0 && errno != EINTR)
      return;
    sent += static_cast<std::size_t>(std::max<ssize_t>(n, 0));
  }
}

// What a library prints while it breaks is no message for anybody.
[[noreturn]] void be_child(int pipe, const std::function<std::string()> &work, double seconds) {
  if (const int nothing = open("/dev/null", O_WRONLY); nothing >= 0) {
    dup2(nothing, STDOUT_FILENO);
    dup2(nothing, STDERR_FILENO);
  }
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  if (std::isfinite(seconds)) {
    const auto most = static_cast<rlim_t>(seconds) + 1;
    const rlimit processor{most, most};
    setrlimit(RLIMIT_CPU, &processor);
  }
  for (const int signal : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL, SIGINT, SIGTERM})
    std::signal(signal, SIG_DFL);
  send(pipe, outcome_of(work));
  _exit(0);
}

std::string received(int pipe) {
  std::string text;
  std::string part(1 << 16, '\0');
  for (ssize_t n; (n = read(pipe, part.data(), part.size())) != 0;)
    if (n > 0)
      text.append(part, 0, static_cast<std::size_t>(n));
    else if (errno != EINTR)
      break;
  return text;
}

std::string ending_of(pid_t child) {
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0)
    return "";
  if (WIFSIGNALED(status) && (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL))
    return "does not come to an end on it, or takes too much memory";
  return "crashed on it";
}

}  // namespace

std::string in_child_process(const std::function<std::string()> &work, double most_seconds) {
  int ends[2];
  if (pipe(ends) != 0)
    throw MachineError(fmt::format("no pipe can be opened: {}", std::strerror(errno)));
  const pid_t child = fork();
  if (child < 0)
    throw MachineError(fmt::format("no process can be started: {}", std::strerror(errno)));
  if (child == 0) {
    close(ends[0]);
    be_child(ends[1], work, most_seconds);
  }
  close(ends[1]);
  const std::string text = received(ends[0]);
  close(ends[0]);
  const std::string ending = ending_of(child);
  if (!ending.empty() || text.empty())
    throw CaseError("cannot be read, it may be damaged: the library that reads it " +
                    (ending.empty() ? "ended without a word" : ending));
  if (text[0] == wrong_case)
    throw CaseError(text.substr(1));
  if (text[0] == machine_failed)
    throw MachineError(text.substr(1));
  return text.substr(1);
}

}  // namespace tourmaline::mesh
