#include "parallel/team.h"

#include <fmt/format.h>

#include <system_error>
#include <utility>

#include "tourmaline/error.h"

namespace tourmaline::parallel {

Team::Team(int members) {
  try {
    for (int member = 1; member < members; ++member)
      others_.emplace_back(&Team::work, this, member);
  } catch (const std::system_error &error) {
    const int there = this->members();
    leave();
    throw MachineError(
        fmt::format("the system gives this process only {} of the {} threads that it needs ({}); "
                    "lower solver.threads or raise the limit (ulimit -u, ulimit -v)",
                    there, members, error.code().message()));
  }
}

Team::~Team() {
  leave();
}

void Team::leave() {
  leaving_ = true;
  ++round_;
  round_.notify_all();
  for (std::thread &other : others_)
    other.join();
}

void Team::share_out_to_all(int tasks, const Task &task) {
  task_ = &task;
  tasks_ = tasks;
  next_ = 0;
  at_work_ = static_cast<int>(others_.size());
  ++round_;
  round_.notify_all();
  take_tasks(0);
  for (int left = at_work_; left > 0; left = at_work_)
    at_work_.wait(left);
  if (thrown_)
    std::rethrow_exception(std::exchange(thrown_, nullptr));
}

void Team::take_tasks(int member) {
  try {
    for (int k = next_++; k < tasks_; k = next_++)
      (*task_)(k, member);
  } catch (...) {
    next_ = tasks_;
    const std::lock_guard lock(mutex_);
    thrown_ = std::current_exception();
  }
}

void Team::work(int member) {
  for (unsigned round = 0;; ++round) {
    round_.wait(round);
    if (leaving_)
      return;
    take_tasks(member);
    if (--at_work_ == 0)
      at_work_.notify_one();
  }
}

}  // namespace tourmaline::parallel
