#include "report/view.h"

#include <algorithm>
#include <cmath>

#include "report/vectors.h"

namespace tourmaline::report {
namespace {

Vector3 unit(const Vector3 &a) {
  const double length = std::max(std::sqrt(dot(a, a)), 1e-300);
  return {a[0] / length, a[1] / length, a[2] / length};
}

/// Right, up, away: the rows of the rotation into the view. The page looks from the same side.
std::array<Vector3, 3> directions(int dimension) {
  if (dimension == 2)
    return {{{1, 0, 0}, {0, 1, 0}, {0, 0, -1}}};
  const Vector3 to_eye = unit({-5, -7, 4.5});
  const Vector3 right = unit(cross({0, 0, 1}, to_eye));
  return {{right, cross(to_eye, right), {-to_eye[0], -to_eye[1], -to_eye[2]}}};
}

Vector3 deformed(const Result &result, std::size_t node, double scale) {
  Vector3 place = result.points[node];
  const Field *u = result.field("displacement");
  for (std::size_t c = 0; u && c < u->values.size(); ++c) {
    const std::size_t first = u->values[c].size() - result.points.size();
    place[c] += scale * u->values[c][first + node];
  }
  return place;
}

}  // namespace

std::array<double, 3> seen(int dimension, const Vector3 &vector) {
  const auto rows = directions(dimension);
  return {dot(rows[0], vector), dot(rows[1], vector), dot(rows[2], vector)};
}

std::array<std::array<double, 3>, 3> solid_axes() {
  const auto rows = directions(3);
  std::array<Vector3, 3> axes;
  for (int axis = 0; axis < 3; ++axis)
    axes[axis] = {rows[0][axis], rows[1][axis], rows[2][axis]};
  return axes;
}

View view_of(const Result &result, double scale) {
  const auto rows = directions(result.dimension);
  View view;
  view.low = {1e300, 1e300};
  view.high = {-1e300, -1e300};
  for (std::size_t node = 0; node < result.points.size(); ++node) {
    const Vector3 place = deformed(result, node, scale);
    view.places.push_back({dot(rows[0], place), dot(rows[1], place), dot(rows[2], place)});
    for (int i = 0; i < 2; ++i) {
      view.low[i] = std::min(view.low[i], view.places.back()[i]);
      view.high[i] = std::max(view.high[i], view.places.back()[i]);
    }
  }
  for (const auto &t : result.skin.triangles) {
    const Vector3 normal = unit(cross(from_to(view.places[t[0]], view.places[t[1]]),
                                      from_to(view.places[t[0]], view.places[t[2]])));
    view.light.push_back(result.dimension == 2 ? 1 : 0.62 + 0.38 * std::abs(normal[2]));
  }
  return view;
}

}  // namespace tourmaline::report
