#pragma once

#include <atomic>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace tourmaline::parallel {

/// Threads that share out tasks among themselves; whoever asks is the first of them. They sleep
/// between tasks, after some microseconds.
class Team {
 public:
  /// Of so many members, itself included. Throws MachineError where there cannot be as many
  /// threads.
  explicit Team(int members);
  ~Team();
  Team(const Team &) = delete;
  Team &operator=(const Team &) = delete;

  int members() const { return static_cast<int>(others_.size()) + 1; }

  /// Calls task(k, member) for k = 0 ... tasks - 1, each once, in any order, by whichever member is
  /// free; ends when all have ended. Where some throw, one of their exceptions is thrown then, and
  /// tasks that had not begun are left out. Not to be called from within a task of this team.
  template <typename Task>
  void share_out(int tasks, const Task &task) {
    if (others_.empty() || tasks < 2)
      for (int k = 0; k < tasks; ++k)
        task(k, 0);
    else
      share_out_to_all(tasks, std::cref(task));
  }

 private:
  using Task = std::function<void(int task, int member)>;

  void share_out_to_all(int tasks, const Task &task);
  void work(int member);
  void take_tasks(int member);
  void leave();

  std::vector<std::thread> others_;
  const Task *task_ = nullptr;  // of the round, as is what follows it
  int tasks_ = 0;
  bool leaving_ = false;
  std::atomic<int> next_ = 0, at_work_ = 0;  // the next task; how many of the others
  std::atomic<unsigned> round_ = 0;
  std::mutex mutex_;  // of what is thrown
  std::exception_ptr thrown_;
};

}  // namespace tourmaline::parallel
