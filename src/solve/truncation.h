#pragma once

#include <Eigen/Dense>
#include <vector>

#include "solve/interface_newton.h"

namespace tourmaline::solve {

/// Where a point's slip may have to stop on its way: at the kink of its law, and where a known slip
/// makes a bend of it, at that.
enum class Turns { kinks, kinks_and_bends };

/// The length of `direction` at which the point's slip in d has no component left along its present
/// one: there, on a line exactly and on a disc nearly, it meets the kink or bend of its law.
/// Infinite where there is none. d [m] and `direction` have the entries of all points.
double length_to_turn(const ContactPoint &point, const Eigen::VectorXd &d,
                      const Eigen::VectorXd &direction, Turns turns);

/// d + length direction, but a point that comes to its turn stops there, at exactly zero: beyond it
/// the Newton model does not hold.
Eigen::VectorXd truncated_step(const std::vector<ContactPoint> &points, const Eigen::VectorXd &d,
                               const Eigen::VectorXd &direction, double length, Turns turns);

}  // namespace tourmaline::solve
