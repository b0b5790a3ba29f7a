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

/// Whether an iteration gets on so slowly that another one had better go on: in `patience` rounds
/// the residual has not come down to a tenth. 0: never.
class Creep {
 public:
  explicit Creep(int patience) : patience_(patience) {}

  bool see(double residual) {
    const bool fell = residual < 0.1 * least_;
    rounds_ = fell ? 0 : rounds_ + 1;
    least_ = fell ? residual : least_;
    return patience_ > 0 && rounds_ >= patience_;
  }

 private:
  int patience_, rounds_ = 0;
  double least_ = std::numeric_limits<double>::infinity();
};

}  // namespace tourmaline::solve
