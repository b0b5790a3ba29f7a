#pragma once

#include <Eigen/Dense>

namespace tourmaline::contact {

/// Components along the admissible tangential directions of a contact point: none, one or two.
using Tangent = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 2, 1>;
using TangentMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 2, 2>;

}  // namespace tourmaline::contact
