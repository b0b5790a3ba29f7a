#include "random_mesh.h"

#include <algorithm>
#include <array>
#include <numbers>

namespace tourmaline::testing {
namespace {

using Index = std::vector<int>;  // of a vertex or cell in the grid, by axis

class Grid {
 public:
  explicit Grid(const MeshShape &shape) : shape_(shape) {}

  bool closed(int axis) const { return shape_.ring && axis == 1; }
  int vertices(int axis) const { return shape_.cells[axis] + (closed(axis) ? 0 : 1); }
  int number(const Index &at) const {
    int result = 0;
    for (int axis = shape_.dimension; axis-- > 0;)
      result = result * vertices(axis) + at[axis] % vertices(axis);
    return result;
  }
  /// All indices below `counts`, the first axis fastest.
  template <class Visit>
  void each(const Index &counts, const Visit &visit) const {
    Index at(counts.size(), 0);
    for (std::size_t axis = 0; axis < counts.size();) {
      visit(at);
      for (axis = 0; axis < counts.size() && ++at[axis] == counts[axis]; ++axis)
        at[axis] = 0;
    }
  }
  bool ends(const Index &at, int side) const {
    return !closed(side / 2) && at[side / 2] == (side % 2 == 0 ? 0 : shape_.cells[side / 2]);
  }
  Eigen::VectorXd place(const Index &at, Random &random) const {
    bool inside = true;
    for (int side = 0; side < 2 * shape_.dimension; ++side)
      inside = inside && !ends(at, side);
    Eigen::VectorXd s(shape_.dimension);
    for (int axis = 0; axis < shape_.dimension; ++axis)
      s[axis] = (at[axis] + (inside ? random.between(-0.15, 0.15) : 0)) / shape_.cells[axis];
    return shape_.ring ? on_ring(s) : on_box(s);
  }

 private:
  Eigen::VectorXd on_box(Eigen::VectorXd s) const {
    for (int axis = 0; axis < shape_.dimension; ++axis)
      s[axis] *= shape_.size[axis];
    return s;
  }
  Eigen::VectorXd on_ring(Eigen::VectorXd s) const {
    const double radius = shape_.size[0] + s[0] * (shape_.size[1] - shape_.size[0]),
                 angle = 2 * std::numbers::pi * s[1];
    s.head(2) << radius * std::cos(angle), radius * std::sin(angle);
    if (shape_.dimension == 3)
      s[2] *= shape_.size[2];
    return s;
  }

  const MeshShape &shape_;
};

Index step(Index at, int axis) {
  ++at[axis];
  return at;
}

// Kuhn's simplices: one for each order in which the axes lead from the first corner to the last.
std::vector<std::vector<Index>> simplices_of(const Index &first) {
  std::vector<std::vector<Index>> all;
  std::vector<int> axes(first.size());
  for (std::size_t i = 0; i < axes.size(); ++i)
    axes[i] = static_cast<int>(i);
  do {
    std::vector<Index> path{first};
    Eigen::MatrixXd order = Eigen::MatrixXd::Zero(first.size(), first.size());
    for (std::size_t i = 0; i < axes.size(); ++i) {
      path.push_back(step(path.back(), axes[i]));
      order(static_cast<Eigen::Index>(i), axes[i]) = 1;
    }
    if (order.determinant() < 0)
      std::swap(path[path.size() - 2], path.back());
    all.push_back(path);
  } while (std::next_permutation(axes.begin(), axes.end()));
  return all;
}

std::vector<Index> cuboid_of(const Index &first) {
  std::vector<Index> corners{first, step(first, 0), step(step(first, 0), 1), step(first, 1)};
  for (std::size_t i = 0; first.size() == 3 && i < 4; ++i)
    corners.push_back(step(corners[i], 2));
  return corners;
}

// Local vertices of a cell's facets, in Gmsh's order.
std::vector<std::vector<int>> facets_of(std::size_t vertices, int dimension) {
  if (dimension == 2)
    return vertices == 3 ? std::vector<std::vector<int>>{{0, 1}, {1, 2}, {2, 0}}
                         : std::vector<std::vector<int>>{{0, 1}, {1, 2}, {2, 3}, {3, 0}};
  if (vertices == 4)
    return {{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}};
  return {{0, 1, 2, 3}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
}

void add_cell(SampleMesh &mesh, const Grid &grid, const std::vector<Index> &corners, int region) {
  mesh.cells.emplace_back();
  mesh.region.push_back(region);
  for (const Index &corner : corners)
    mesh.cells.back().push_back(grid.number(corner));
  const int dimension = static_cast<int>(corners[0].size());
  for (const auto &local : facets_of(corners.size(), dimension))
    for (int side = 0; side < 2 * dimension; ++side)
      if (std::all_of(local.begin(), local.end(),
                      [&](int v) { return grid.ends(corners[v], side); })) {
        mesh.facets.emplace_back();
        for (const int v : local)
          mesh.facets.back().push_back(mesh.cells.back()[v]);
        mesh.side.push_back(side);
      }
}

}  // namespace

SampleMesh random_mesh(const MeshShape &shape, Random &random) {
  const Grid grid(shape);
  SampleMesh mesh;
  mesh.simplices = shape.simplices;
  Index counts;
  for (int axis = 0; axis < shape.dimension; ++axis)
    counts.push_back(grid.vertices(axis));
  grid.each(counts, [&](const Index &at) { mesh.points.push_back(grid.place(at, random)); });
  grid.each(shape.cells, [&](const Index &at) {
    const int axis = shape.layered / 2, n = shape.cells[axis],
              depth = shape.layered % 2 == 0 ? at[axis] : n - 1 - at[axis];
    const int region = shape.regions == 2 && 2 * depth + 1 > n ? 1 : 0;
    if (!shape.simplices)
      return add_cell(mesh, grid, cuboid_of(at), region);
    for (const auto &corners : simplices_of(at))
      add_cell(mesh, grid, corners, region);
  });
  return mesh;
}

}  // namespace tourmaline::testing
