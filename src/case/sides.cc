#include "case/sides.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace tourmaline::casefile {

namespace {

using Eigen::Vector3d;

std::vector<SidePoint> points_on(const Box &box, const Side &side) {
  std::vector<SidePoint> all;
  const int dimension = static_cast<int>(box.min.size());
  for (int corner = 0; corner < 1 << dimension; ++corner) {
    SidePoint at;
    for (int axis = 0; axis < dimension; ++axis)
      at.point[axis] = (corner >> axis & 1) != 0 ? box.max[axis] : box.min[axis];
    at.normal[side.axis] = side.greatest ? 1 : -1;
    if ((corner >> side.axis & 1) == (side.greatest ? 1 : 0))
      all.push_back(at);
  }
  return all;
}

// Five points of a circle: three would do for an affine function, and more are no harm.
void add_circle(double radius, double z, const std::string &side, std::vector<SidePoint> &all) {
  constexpr int n = 5;
  for (int k = 0; k < n; ++k) {
    const double angle = 2 * std::numbers::pi * k / n, x = std::cos(angle), y = std::sin(angle);
    SidePoint at{{radius * x, radius * y, z}, {}};
    if (side == "inner")
      at.normal = {-x, -y, 0};
    else if (side == "outer")
      at.normal = {x, y, 0};
    else
      at.normal = {0, 0, side == "top" ? 1. : -1.};
    all.push_back(at);
  }
}

std::vector<SidePoint> points_on(const Annulus &ring, const std::string &side) {
  std::vector<SidePoint> all;
  const bool tube = dimension_of(ring.cell) == 3;
  for (const double radius : {ring.inner, ring.outer})
    for (const double z : {0., ring.height}) {
      const bool on_side = side == "inner"    ? radius == ring.inner
                           : side == "outer"  ? radius == ring.outer
                           : side == "bottom" ? z == 0
                                              : z == ring.height;
      if (on_side && (tube || z == 0))
        add_circle(radius, z, side, all);
    }
  return all;
}

// The facet's normal, as long as the facet is large, outward or not.
Vector3d normal_of(const MeshFile &mesh, const std::uint32_t *at) {
  const auto point = [&](std::size_t i) {
    return Eigen::Map<const Vector3d>(mesh.points[at[i]].data());
  };
  const Vector3d along = point(1) - point(0);
  return mesh.dimension == 2 ? Vector3d(along.y(), -along.x(), 0)
                             : Vector3d(along.cross(point(2) - point(0)));
}

// All vertices, each with the mean of its facets' normals; these need not be outward here.
std::vector<SidePoint> points_on(const MeshFile &mesh, const std::string &side) {
  const std::vector<int> sets = mesh.boundaries.sets_with(side);
  const std::size_t each = mesh.vertices_per_facet();
  std::map<std::uint32_t, Vector3d> normals;
  for (std::size_t facet = 0; facet < mesh.n_facets(); ++facet) {
    if (std::find(sets.begin(), sets.end(), mesh.boundaries.set_of[facet]) == sets.end())
      continue;
    const std::uint32_t *at = &mesh.facets[facet * each];
    const Vector3d normal = normal_of(mesh, at);
    for (std::size_t i = 0; i < each; ++i) {
      Vector3d &mean = normals.try_emplace(at[i], Vector3d::Zero()).first->second;
      mean += mean.dot(normal) < 0 ? Vector3d(-normal) : normal;
    }
  }
  std::vector<SidePoint> all;
  for (const auto &[vertex, mean] : normals) {
    const Vector3d normal = mean.normalized();
    all.push_back({mesh.points[vertex], {normal.x(), normal.y(), normal.z()}});
  }
  return all;
}

}  // namespace

const std::vector<Side> &sides(int dimension) {
  static const std::vector<Side> square = {
      {"left", 0, false}, {"right", 0, true}, {"bottom", 1, false}, {"top", 1, true}};
  static const std::vector<Side> cube = {{"left", 0, false},   {"right", 0, true},
                                         {"bottom", 2, false}, {"top", 2, true},
                                         {"front", 1, false},  {"back", 1, true}};
  return dimension == 2 ? square : cube;
}

std::vector<std::string> side_names(const MeshCase &mesh) {
  const int dimension = dimension_of(mesh);
  if (mesh.annulus)
    return dimension == 2 ? std::vector<std::string>{"inner", "outer"}
                          : std::vector<std::string>{"inner", "outer", "bottom", "top"};
  if (mesh.content)
    return mesh.content->boundary_names();
  std::vector<std::string> names;
  for (const Side &side : sides(dimension))
    names.push_back(side.name);
  return names;
}

std::vector<SidePoint> points_on(const MeshCase &mesh, const std::string &name) {
  if (mesh.annulus)
    return points_on(*mesh.annulus, name);
  if (mesh.content)
    return points_on(*mesh.content, name);
  for (const Side &side : sides(dimension_of(mesh)))
    if (mesh.box && side.name == name)
      return points_on(*mesh.box, side);
  return {};
}

}  // namespace tourmaline::casefile
