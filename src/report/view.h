#pragma once

#include <array>
#include <vector>

#include "report/result.h"

namespace tourmaline::report {

/// A body seen from one direction: a plane one from the front, a solid one from in front, left and
/// above. x to the right, y up, depth away from the eye [m].
struct View {
  std::vector<std::array<double, 3>> places;  ///< of the skin's nodes, deformed
  std::array<double, 2> low{}, high{};        ///< of x and y
  std::vector<double> light;                  ///< of each triangle, 0 to 1

  double width() const { return high[0] - low[0]; }
  double height() const { return high[1] - low[1]; }
};

/// The last state that `result` holds, displacements `scale` times as large.
View view_of(const Result &result, double scale);

/// A vector of a body in the axes of its view: to the right, up, away from the eye.
std::array<double, 3> seen(int dimension, const Vector3 &vector);

/// The directions of the axes x, y, z in the view of a solid body.
std::array<std::array<double, 3>, 3> solid_axes();

}  // namespace tourmaline::report
