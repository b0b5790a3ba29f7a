#pragma once

#include <limits>

namespace tourmaline::solve {

/// Whether what the rounds of a fixed point leave has come down to round-off: little, and not
/// halved in several rounds.
class Stall {
 public:
  /// `lack`: over the size of what is looked for.
  bool see(double lack) {
    constexpr int patience = 5;
    constexpr double little = 1e-9;
    since_ = lack < least_ / 2 ? 0 : since_ + 1;
    least_ = lack < least_ / 2 ? lack : least_;
    return since_ >= patience && lack <= little;
  }

 private:
  double least_ = std::numeric_limits<double>::infinity();
  int since_ = 0;
};

}  // namespace tourmaline::solve
