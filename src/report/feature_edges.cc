#include "report/feature_edges.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace tourmaline::report {
namespace {

/// Faces that meet at less than 30 degrees are one curved face.
constexpr double smooth = 0.8660254037844386;

Vector3 normal_of(const Result &result, const std::array<std::uint32_t, 3> &triangle) {
  const Vector3 &a = result.points[triangle[0]], &b = result.points[triangle[1]],
                &c = result.points[triangle[2]];
  Vector3 normal{};
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    normal[i] = (b[j] - a[j]) * (c[k] - a[k]) - (b[k] - a[k]) * (c[j] - a[j]);
  }
  const double length = std::max(std::hypot(normal[0], normal[1], normal[2]), 1e-300);
  for (double &component : normal)
    component /= length;
  return normal;
}

}  // namespace

std::vector<std::array<std::uint32_t, 2>> feature_edges(const Result &result) {
  std::map<std::array<std::uint32_t, 2>, std::vector<Vector3>> sides;
  for (const auto &triangle : result.skin.triangles) {
    const Vector3 normal = normal_of(result, triangle);
    for (int k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(triangle[k], triangle[(k + 1) % 3]);
      sides[{low, high}].push_back(normal);
    }
  }
  std::vector<std::array<std::uint32_t, 2>> edges;
  for (const auto &[side, normals] : sides) {
    const bool is_smooth = normals.size() == 2 &&
                           std::abs(normals[0][0] * normals[1][0] + normals[0][1] * normals[1][1] +
                                    normals[0][2] * normals[1][2]) >= smooth;
    if (!is_smooth)
      edges.push_back(side);
  }
  return edges;
}

}  // namespace tourmaline::report
