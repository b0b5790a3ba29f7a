#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>

namespace tourmaline::sweep {

/// Copies of this process that work side by side: they need not load its libraries again, which
/// takes longer than a small case. They end with this process, whatever ends it, and do not hear of
/// what is typed at the terminal. While it lives, SIGHUP, SIGINT and SIGTERM only leave a note. One
/// at a time, and of a process without other threads that hold locks.
class Processes {
 public:
  /// What a copy does; its exit status.
  using Work = std::function<int()>;

  /// How one of them ended.
  struct End {
    std::size_t number;
    int status;  ///< of its exit; 128 + signal when one killed it
  };

  Processes();
  Processes(const Processes &) = delete;
  Processes &operator=(const Processes &) = delete;
  /// Kills those that still run.
  ~Processes();

  /// Starts a copy, whose stdout and stderr go to `log` and which has no other open files. Throws
  /// MachineError.
  void start(std::size_t number, const Work &work, const std::filesystem::path &log);

  /// The next one that ends; nothing when none did in that time, or a signal came.
  std::optional<End> wait(std::chrono::milliseconds most);

  std::size_t running() const { return numbers_.size(); }
  void send(int signal) const;

  /// SIGHUP, SIGINT or SIGTERM, if one came since this was last asked; otherwise 0.
  int take_signal();

 private:
  std::optional<End> ended();

  std::map<pid_t, std::size_t> numbers_;
};

}  // namespace tourmaline::sweep
