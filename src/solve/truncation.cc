#include "solve/truncation.h"

#include <limits>

namespace tourmaline::solve {

using contact::Tangent;
using Eigen::VectorXd;

double length_to_turn(const ContactPoint &point, const VectorXd &d, const VectorXd &direction,
                      Turns turns) {
  const Tangent slip = point.slip(d);
  const double backwards = -slip.dot(direction.segment(point.offset, point.size));
  const bool turns_here = point.size > 0 && backwards > 0 &&
                          (point.law.has_kink(point.size) ||
                           (turns == Turns::kinks_and_bends && point.law.has_bend(point.size)));
  return turns_here ? slip.squaredNorm() / backwards : std::numeric_limits<double>::infinity();
}

VectorXd truncated_step(const std::vector<ContactPoint> &points, const VectorXd &d,
                        const VectorXd &direction, double length, Turns turns) {
  VectorXd next = d + length * direction;
  for (const ContactPoint &p : points)
    if (length >= length_to_turn(p, d, direction, turns))
      p.hold(next);
  return next;
}

}  // namespace tourmaline::solve
