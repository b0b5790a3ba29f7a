#pragma once

#include <Eigen/Dense>

namespace tourmaline::solve {

/// Goes towards the images of a fixed point by a share of the way, of each unknown its own: half as
/// much where it has just been told to turn back, more where it goes on the same way. Slow, but it
/// comes near where a map answers too strongly. (M. Riedmiller, H. Braun, IEEE ICNN (1993)
/// 586-591.)
class CalmSteps {
 public:
  /// The next x, from x and the image that the fixed point's map has of it.
  Eigen::VectorXd next(const Eigen::VectorXd &x, const Eigen::VectorXd &image);

 private:
  Eigen::VectorXd share_, last_;  // and the last way to an image
};

}  // namespace tourmaline::solve
