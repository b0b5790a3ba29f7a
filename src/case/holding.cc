#include "tourmaline/case/holding.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <map>
#include <set>

#include "tourmaline/case/sides.h"
#include "tourmaline/error.h"

namespace tourmaline::casefile {

namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;

// Of the supports' rows, whose entries are of order one.
constexpr double tolerance = 1e-9;

Eigen::Index rank(const MatrixXd &matrix) {
  if (matrix.rows() == 0)
    return 0;
  Eigen::JacobiSVD<MatrixXd> svd(matrix);
  return (svd.singularValues().array() > tolerance).count();
}

/// The rows that a rigid motion v(p) = T + W x (p - c)/l must annihilate: d.T + ((p - c)/l x d).W =
/// 0 for a support at p in the direction d.
struct Constraints {
  MatrixXd translation, rotation;
};

Vector3d vector(const std::array<double, 3> &a, int dimension) {
  return {a[0], a[1], dimension == 3 ? a[2] : 0.0};
}

Constraints constraints_of(int dimension, const std::vector<Support> &supports) {
  Vector3d centre = Vector3d::Zero();
  for (const Support &support : supports)
    centre += vector(support.point, dimension) / static_cast<double>(supports.size());
  double length = 0;
  for (const Support &support : supports)
    length = std::max(length, (vector(support.point, dimension) - centre).norm());
  if (length == 0)
    length = 1;
  const auto rows = static_cast<Eigen::Index>(supports.size());
  Constraints all{MatrixXd(rows, dimension), MatrixXd(rows, dimension == 2 ? 1 : 3)};
  for (Eigen::Index i = 0; i < rows; ++i) {
    const Support &support = supports[static_cast<std::size_t>(i)];
    const Vector3d arm = (vector(support.point, dimension) - centre) / length;
    const Vector3d direction = vector(support.direction, dimension);
    const Vector3d moment = arm.cross(direction);
    all.translation.row(i) = direction.head(dimension).transpose();
    all.rotation.row(i) = moment.tail(all.rotation.cols()).transpose();
  }
  return all;
}

bool can_rotate_about(const Constraints &constraints, Eigen::Index axis) {
  const Eigen::VectorXd turning = constraints.rotation.col(axis);
  if (turning.size() == 0)
    return true;
  // Some translation must undo what the rotation does at the supports.
  const Eigen::VectorXd translation =
      constraints.translation.completeOrthogonalDecomposition().solve(-turning);
  return (constraints.translation * translation + turning).norm() < tolerance;
}

void add_translations(const Constraints &constraints, std::vector<std::string> &free) {
  const Eigen::Index dimension = constraints.translation.cols();
  Eigen::Index missing = dimension - rank(constraints.translation);
  for (Eigen::Index axis = 0; axis < dimension; ++axis)
    if (constraints.translation.col(axis).norm() < tolerance) {
      free.push_back(fmt::format("a translation along {}", "xyz"[axis]));
      --missing;
    }
  if (missing > 0)
    free.emplace_back("a translation in an oblique direction");
}

void add_rotations(const Constraints &constraints, std::vector<std::string> &free) {
  MatrixXd all(constraints.translation.rows(),
               constraints.translation.cols() + constraints.rotation.cols());
  all << constraints.translation, constraints.rotation;
  const Eigen::Index axes = constraints.rotation.cols();
  Eigen::Index missing = axes - (rank(all) - rank(constraints.translation));
  for (Eigen::Index axis = 0; axis < axes; ++axis)
    if (can_rotate_about(constraints, axis)) {
      free.push_back(axes == 1
                         ? "a rotation in the plane"
                         : fmt::format("a rotation about an axis parallel to {}", "xyz"[axis]));
      --missing;
    }
  if (missing > 0)
    free.emplace_back("a rotation about an oblique axis");
}

std::vector<std::array<double, 3>> corners(const Box &box, const Side &side) {
  std::vector<std::array<double, 3>> all;
  const int dimension = static_cast<int>(box.min.size());
  for (int corner = 0; corner < 1 << dimension; ++corner) {
    std::array<double, 3> point{};
    for (int axis = 0; axis < dimension; ++axis)
      point[axis] = (corner >> axis & 1) != 0 ? box.max[axis] : box.min[axis];
    if ((corner >> side.axis & 1) == (side.greatest ? 1 : 0))
      all.push_back(point);
  }
  return all;
}

// Vertices of the facets with one of the names, and the means of these facets' normals (as long as
// the facets are large), which need not be outward here.
std::map<std::uint32_t, Vector3d> vertices_on(const MeshFile &mesh,
                                              const std::vector<std::string> &names) {
  std::set<int> sets;
  for (const std::string &name : names)
    for (const int set : mesh.boundaries.sets_with(name))
      sets.insert(set);
  std::map<std::uint32_t, Vector3d> normals;
  const std::size_t each = mesh.vertices_per_facet();
  for (std::size_t facet = 0; facet < mesh.n_facets(); ++facet) {
    if (!sets.contains(mesh.boundaries.set_of[facet]))
      continue;
    const std::uint32_t *at = &mesh.facets[facet * each];
    const auto point = [&](std::size_t i) {
      return Eigen::Map<const Vector3d>(mesh.points[at[i]].data());
    };
    const Vector3d along = point(1) - point(0);
    const Vector3d normal = mesh.dimension == 2 ? Vector3d(along.y(), -along.x(), 0)
                                                : Vector3d(along.cross(point(2) - point(0)));
    for (std::size_t i = 0; i < each; ++i) {
      Vector3d &mean = normals.try_emplace(at[i], Vector3d::Zero()).first->second;
      mean += mean.dot(normal) < 0 ? Vector3d(-normal) : normal;
    }
  }
  return normals;
}

// Points at which a rigid motion must vanish to vanish on a boundary: a rigid motion is affine.
std::vector<std::array<double, 3>> points_on(const Case &asked, const std::string &name) {
  std::vector<std::array<double, 3>> points;
  if (asked.mesh.content)
    for (const auto &[vertex, normal] : vertices_on(*asked.mesh.content, {name}))
      points.push_back(asked.mesh.content->points[vertex]);
  else
    for (const Side &side : sides(asked.dimension))
      if (side.name == name)
        points = corners(*asked.mesh.box, side);
  return points;
}

std::array<double, 3> unit_vector(int axis) {
  std::array<double, 3> direction{};
  direction[static_cast<std::size_t>(axis)] = 1;
  return direction;
}

void hold_by_conditions(const Case &asked, std::vector<Support> &supports) {
  for (const BoundaryCase &boundary : asked.boundaries)
    if (boundary.displacement)
      for (const std::string &name : boundary.on)
        for (int i = 0; i < asked.dimension; ++i)
          if ((*boundary.displacement)[static_cast<std::size_t>(i)])
            for (const std::array<double, 3> &point : points_on(asked, name))
              supports.push_back({point, unit_vector(i)});
}

void hold_by_contact(const Case &asked, std::vector<Support> &supports) {
  if (asked.mesh.content) {
    for (const auto &[vertex, normal] : vertices_on(*asked.mesh.content, asked.contact->on)) {
      const Vector3d n = normal.normalized();
      supports.push_back({asked.mesh.content->points[vertex], {n.x(), n.y(), n.z()}});
    }
    return;
  }
  for (const Side &side : sides(asked.dimension))
    if (std::find(asked.contact->on.begin(), asked.contact->on.end(), side.name) !=
        asked.contact->on.end())
      for (const std::array<double, 3> &point : corners(*asked.mesh.box, side))
        supports.push_back({point, unit_vector(side.axis)});
}

std::vector<Support> supports_of(const Case &asked) {
  std::vector<Support> supports;
  hold_by_conditions(asked, supports);
  if (asked.contact && asked.contact->normal == "bilateral")
    hold_by_contact(asked, supports);
  return supports;
}

std::string listed(const std::vector<std::string> &texts) {
  std::string all;
  for (std::size_t i = 0; i < texts.size(); ++i)
    all += (i == 0 ? "" : i + 1 == texts.size() ? " and " : ", ") + texts[i];
  return all;
}

}  // namespace

std::vector<std::string> free_motions(int dimension, const std::vector<Support> &supports) {
  const Constraints constraints = constraints_of(dimension, supports);
  std::vector<std::string> free;
  add_translations(constraints, free);
  add_rotations(constraints, free);
  return free;
}

void check_holding(const Case &asked) {
  const bool grounded = std::any_of(asked.boundaries.begin(), asked.boundaries.end(),
                                    [](const auto &boundary) { return boundary.potential; });
  if (!grounded)
    throw CaseError(asked.source +
                    " [[boundary]]: the electric potential floats, as no boundary "
                    "prescribes it; give `potential` on at least one");
  const std::vector<std::string> free = free_motions(asked.dimension, supports_of(asked));
  if (!free.empty())
    throw CaseError(fmt::format(
        "{} [[boundary]]: nothing holds the body against {}; prescribe further components of "
        "`displacement`{}",
        asked.source, listed(free),
        asked.contact ? " (bilateral contact holds only the normal one)" : ""));
}

}  // namespace tourmaline::casefile
