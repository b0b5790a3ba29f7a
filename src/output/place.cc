#include "output/place.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace tourmaline::output {

double largest_extent(std::span<const Vector3> points) {
  double extent = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto [low, high] = std::minmax_element(
        points.begin(), points.end(),
        [axis](const Vector3 &a, const Vector3 &b) { return a[axis] < b[axis]; });
    extent = std::max(extent, (*high)[axis] - (*low)[axis]);
  }
  return extent;
}

std::vector<std::size_t> sorted_by_place(const std::vector<Vector3> &points) {
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  if (points.empty())
    return order;
  const double unit = 1e-9 * std::max(largest_extent(points), 1e-300);
  std::vector<std::array<double, 3>> key(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    for (int axis = 0; axis < 3; ++axis)
      key[i][axis] = std::round(points[i][axis] / unit);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return key[a] < key[b]; });
  return order;
}

}  // namespace tourmaline::output
