#include "unfolded.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "tourmaline/error.h"

namespace tourmaline::mesh {

namespace {

using casefile::CellShape;
using casefile::MeshFile;
using Eigen::Vector3d;

std::string place(const Vector3d &p) {
  return fmt::format("({:g}, {:g}, {:g})", p[0], p[1], p[2]);
}

std::uint32_t vertex_of(const MeshFile &mesh, std::size_t cell, int local) {
  return mesh.cells[cell * mesh.vertices_per_cell() + static_cast<std::size_t>(local)];
}

Eigen::Map<const Vector3d> point(const MeshFile &mesh, std::uint32_t vertex) {
  return Eigen::Map<const Vector3d>(mesh.points[vertex].data());
}

Vector3d corner(const MeshFile &mesh, std::size_t cell, int local) {
  return point(mesh, vertex_of(mesh, cell, local));
}

Vector3d centre(const MeshFile &mesh, std::span<const std::uint32_t> vertices) {
  Vector3d sum = Vector3d::Zero();
  for (const std::uint32_t vertex : vertices)
    sum += point(mesh, vertex);
  return sum / static_cast<double>(vertices.size());
}

// Corners with the neighbours that span a positive volume when the cell is listed in the right
// order.
const std::vector<std::array<int, 4>> &corners_of(CellShape cell) {
  static const std::vector<std::array<int, 4>> all[] = {
      {{0, 1, 2, 0}, {1, 2, 0, 0}, {2, 0, 1, 0}},
      {{0, 1, 3, 0}, {1, 2, 0, 0}, {2, 3, 1, 0}, {3, 0, 2, 0}},
      {{0, 1, 2, 3}, {1, 2, 0, 3}, {2, 0, 1, 3}, {3, 2, 1, 0}},
      {{0, 1, 3, 4},
       {1, 2, 0, 5},
       {2, 3, 1, 6},
       {3, 0, 2, 7},
       {4, 7, 5, 0},
       {5, 4, 6, 1},
       {6, 5, 7, 2},
       {7, 6, 4, 3}}};
  return all[static_cast<int>(cell)];
}

// Twice the area or six times the volume that the edges at a corner span; its sign says the order.
double spanned(const MeshFile &mesh, std::size_t cell, const std::array<int, 4> &at) {
  const Vector3d origin = corner(mesh, cell, at[0]);
  const Vector3d first = corner(mesh, cell, at[1]) - origin;
  const Vector3d second = corner(mesh, cell, at[2]) - origin;
  return mesh.dimension == 2 ? first.cross(second).z()
                             : first.cross(second).dot(corner(mesh, cell, at[3]) - origin);
}

void turn_over(MeshFile &mesh, std::size_t cell) {
  const auto at = [&](std::size_t local) -> std::uint32_t & {
    return mesh.cells[cell * mesh.vertices_per_cell() + local];
  };
  if (mesh.cell == CellShape::hexahedron)
    for (std::size_t i = 0; i < 4; ++i)
      std::swap(at(i), at(i + 4));
  else if (mesh.cell == CellShape::quadrilateral)
    std::swap(at(1), at(3));
  else
    std::swap(at(0), at(1));
}

/// The map of the unit cube onto a hexahedron, in Gmsh's numbering.
class Trilinear {
 public:
  Trilinear(const MeshFile &mesh, std::size_t cell) {
    constexpr int lexicographic[] = {0, 1, 3, 2, 4, 5, 7, 6};
    for (int i = 0; i < 8; ++i)
      corners_.col(i) = corner(mesh, cell, lexicographic[i]);
  }

  double jacobian(const std::array<double, 3> &at) const {
    Eigen::Matrix3d derivatives;
    for (int axis = 0; axis < 3; ++axis) {
      derivatives.col(axis).setZero();
      for (int i = 0; i < 8; ++i)
        derivatives.col(axis) += slope(i, axis, at) * corners_.col(i);
    }
    return derivatives.col(0).cross(derivatives.col(1)).dot(derivatives.col(2));
  }

 private:
  // Derivative along an axis of the shape function of a corner.
  static double slope(int i, int axis, const std::array<double, 3> &at) {
    double product = 1;
    for (int k = 0; k < 3; ++k) {
      const bool far = (i >> k & 1) != 0;
      if (k == axis)
        product *= far ? 1 : -1;
      else
        product *= far ? at[k] : 1 - at[k];
    }
    return product;
  }

  Eigen::Matrix<double, 3, 8> corners_;
};

// The Jacobian is quadratic in each of the three coordinates. From its values at 0, 1/2 and 1
// follow its Bernstein coefficients; it is nowhere less than the least of them.
double least_coefficient(const Trilinear &map) {
  double b[3][3][3];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k)
        b[i][j][k] = map.jacobian({0.5 * i, 0.5 * j, 0.5 * k});
  const auto transform = [](double first, double &middle, double last) {
    middle = 2 * middle - (first + last) / 2;
  };
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      transform(b[i][j][0], b[i][j][1], b[i][j][2]);
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k)
      transform(b[i][0][k], b[i][1][k], b[i][2][k]);
  for (int j = 0; j < 3; ++j)
    for (int k = 0; k < 3; ++k)
      transform(b[0][j][k], b[1][j][k], b[2][j][k]);
  return *std::min_element(&b[0][0][0], &b[0][0][0] + 27);
}

// Ends, middle and Gauss points of two, three and four on a line, the rules of integration.
constexpr std::array<double, 12> stations = {0,
                                             1,
                                             0.5,
                                             0.21132486540518713,
                                             0.78867513459481287,
                                             0.11270166537925831,
                                             0.88729833462074170,
                                             0.069431844202973714,
                                             0.33000947820757187,
                                             0.66999052179242813,
                                             0.93056815579702623,
                                             0.25};

// Where the coefficients do not say that the Jacobian is positive, its values do.
bool is_unfolded(const Trilinear &map) {
  if (least_coefficient(map) > 0)
    return true;
  for (const double x : stations)
    for (const double y : stations)
      for (const double z : stations)
        if (!(map.jacobian({x, y, z}) > 0))
          return false;
  return true;
}

[[noreturn]] void fail_degenerate(const MeshFile &mesh, std::size_t cell) {
  throw CaseError("has a cell at " + place(corner(mesh, cell, 0)) +
                  " that is degenerate: flat, folded or not convex");
}

}  // namespace

const std::vector<std::vector<int>> &facets_of(CellShape cell) {
  static const std::vector<std::vector<int>> all[] = {
      {{0, 1}, {1, 2}, {2, 0}},
      {{0, 1}, {1, 2}, {2, 3}, {3, 0}},
      {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}},
      {{0, 3, 2, 1}, {0, 1, 5, 4}, {0, 4, 7, 3}, {1, 2, 6, 5}, {2, 3, 7, 6}, {4, 5, 6, 7}}};
  return all[static_cast<int>(cell)];
}

// Of all shapes but the hexahedron the Jacobian is extreme at the corners.
void orient(MeshFile &mesh) {
  for (std::size_t cell = 0; cell < mesh.n_cells(); ++cell) {
    int positive = 0, negative = 0;
    for (const std::array<int, 4> &at : corners_of(mesh.cell)) {
      const double volume = spanned(mesh, cell, at);
      positive += volume > 0 && std::isfinite(volume) ? 1 : 0;
      negative += volume < 0 && std::isfinite(volume) ? 1 : 0;
    }
    const int corners = static_cast<int>(corners_of(mesh.cell).size());
    if (positive < corners && negative < corners)
      fail_degenerate(mesh, cell);
    if (negative == corners)
      turn_over(mesh, cell);
    if (mesh.cell == CellShape::hexahedron && !is_unfolded(Trilinear(mesh, cell)))
      fail_degenerate(mesh, cell);
  }
}

namespace {

// Around a facet both its cells go against each other, each seeing it from its own side.
bool are_opposite(std::span<const std::uint32_t> a, std::span<const std::uint32_t> b) {
  const std::size_t n = a.size();
  if (n == 2)
    return a[0] == b[1] && a[1] == b[0];
  const auto start = static_cast<std::size_t>(std::find(b.begin(), b.end(), a[0]) - b.begin());
  for (std::size_t i = 0; i < n; ++i)
    if (b[(start + n - i) % n] != a[i])
      return false;
  return true;
}

void check_sides(const MeshFile &mesh, std::span<const std::uint32_t> faces,
                 const ElementTable &table) {
  const std::size_t each = mesh.vertices_per_facet();
  table.for_each([&](std::span<const std::uint32_t> same) {
    if (same.size() != 2)
      return;
    const auto first = faces.subspan(same[0] * each, each);
    if (!are_opposite(first, faces.subspan(same[1] * each, each)))
      throw CaseError("is folded at " + place(centre(mesh, first)) +
                      ": both cells of the facet there lie on the same side of it");
  });
}

// Sums of many angles of cells that fit together are exact to round-off.
constexpr double full_angle = 2 * std::numbers::pi * (1 + 1e-6);

[[noreturn]] void fail_wound(const Vector3d &at) {
  throw CaseError("is folded: the cells around " + place(at) +
                  " overlap, together they fill more than the full angle");
}

void check_turns_in_the_plane(const MeshFile &mesh) {
  std::vector<double> angles(mesh.points.size(), 0);
  for (std::size_t cell = 0; cell < mesh.n_cells(); ++cell)
    for (const auto &[at, a, b, unused] : corners_of(mesh.cell)) {
      const Vector3d origin = corner(mesh, cell, at);
      const Vector3d first = corner(mesh, cell, a) - origin,
                     second = corner(mesh, cell, b) - origin;
      angles[vertex_of(mesh, cell, at)] +=
          std::atan2(first.cross(second).norm(), first.dot(second));
    }
  for (std::uint32_t vertex = 0; vertex < angles.size(); ++vertex)
    if (angles[vertex] > full_angle)
      fail_wound(point(mesh, vertex));
}

// Angle between the half planes that an axis bounds and that contain a and b.
double dihedral(const Vector3d &axis, const Vector3d &a, const Vector3d &b) {
  const Vector3d first = axis.cross(a), second = axis.cross(b);
  return std::atan2(first.cross(second).norm(), first.dot(second));
}

// Of a hexahedron's bent facets the angle is that of their tangents at one end of the edge, the
// same one for all its cells.
void check_turns_in_space(const MeshFile &mesh) {
  std::vector<std::pair<std::uint64_t, double>> angles;  // by edge
  for (std::size_t cell = 0; cell < mesh.n_cells(); ++cell)
    for (const auto &[at, a, b, c] : corners_of(mesh.cell)) {
      const Vector3d origin = corner(mesh, cell, at);
      const std::uint32_t from = vertex_of(mesh, cell, at);
      for (const auto &[end, one, other] : {std::array{a, b, c}, {b, c, a}, {c, a, b}})
        if (const std::uint32_t to = vertex_of(mesh, cell, end); from < to)
          angles.emplace_back(
              std::uint64_t{from} << 32 | to,
              dihedral(corner(mesh, cell, end) - origin, corner(mesh, cell, one) - origin,
                       corner(mesh, cell, other) - origin));
    }
  std::sort(angles.begin(), angles.end());
  double sum = 0;
  for (std::size_t i = 0; i < angles.size(); ++i) {
    sum = angles[i].second + (i > 0 && angles[i - 1].first == angles[i].first ? sum : 0);
    if (sum > full_angle)
      fail_wound((point(mesh, static_cast<std::uint32_t>(angles[i].first >> 32)) +
                  point(mesh, static_cast<std::uint32_t>(angles[i].first))) /
                 2);
  }
}

}  // namespace

void check_unfolded(const MeshFile &mesh, std::span<const std::uint32_t> faces,
                    const ElementTable &table) {
  check_sides(mesh, faces, table);
  if (mesh.dimension == 2)
    check_turns_in_the_plane(mesh);
  else
    check_turns_in_space(mesh);
}

}  // namespace tourmaline::mesh
