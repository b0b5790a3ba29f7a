#pragma once

#include <Eigen/Dense>

namespace tourmaline::contact {

/// Components along tangential directions of a contact point: none, one or two.
using Tangent = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 2, 1>;
using TangentMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 2, 2>;

/// A difference of two displacements of the given size [m]; zero where it is no more than their
/// round-off, so that what is held at rest has no slip.
inline Tangent beyond_round_off(const Tangent &difference, double size) {
  return difference.norm() > 1e-14 * size ? difference : Tangent(Tangent::Zero(difference.size()));
}

}  // namespace tourmaline::contact
