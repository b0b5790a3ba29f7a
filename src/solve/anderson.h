#pragma once

#include <Eigen/Dense>
#include <deque>

namespace tourmaline::solve {

/// Mixes the last iterates of a fixed point so that what they changed by cancels best. (D. G.
/// Anderson, J. ACM 12 (1965) 547-560.)
class Anderson {
 public:
  /// The next x, from x and the image that the fixed point's map has of it.
  Eigen::VectorXd next(const Eigen::VectorXd &x, const Eigen::VectorXd &image);

 private:
  std::deque<Eigen::VectorXd> images_, changes_;
};

}  // namespace tourmaline::solve
