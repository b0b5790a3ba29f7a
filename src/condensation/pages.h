#pragma once

#include <cstddef>
#include <utility>

#include "parallel/team.h"

namespace tourmaline::condensation {

/// Doubles, zero at first, in memory of their own: in huge pages, each near the thread that uses it
/// first; in small ones, all taken here by the whole team, where a virtual machine has given huge
/// ones back to its host. Throws MachineError where there is not enough.
class Pages {
 public:
  Pages() = default;
  explicit Pages(std::size_t doubles);
  Pages(std::size_t doubles, parallel::Team &team);
  ~Pages();
  Pages(Pages &&other) noexcept
      : data_(std::exchange(other.data_, nullptr)), size_(std::exchange(other.size_, 0)) {}
  Pages &operator=(Pages &&other) noexcept {
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
    return *this;
  }

  double *data() const { return data_; }
  std::size_t size() const { return size_; }

 private:
  double *data_ = nullptr;
  std::size_t size_ = 0;
};

/// What is pushed last is popped first.
class Stack {
 public:
  Stack(std::size_t doubles, parallel::Team &team) : pages_(doubles, team) {}
  /// Zeros.
  double *push(std::size_t doubles);
  void pop(std::size_t doubles) { used_ -= doubles; }

 private:
  Pages pages_;
  std::size_t used_ = 0, touched_ = 0;
};

}  // namespace tourmaline::condensation
