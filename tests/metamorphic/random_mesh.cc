#include "random_mesh.h"

#include <algorithm>
#include <numbers>
#include <numeric>

namespace tourmaline::verified {
namespace {

using Index = std::vector<int>;  // of a vertex or cell in the grid, by axis

class Grid {
 public:
  explicit Grid(const MeshShape &shape) : shape_(shape) {}

  bool closed(int axis) const { return shape_.ring && axis == 1; }
  Index vertices() const {
    Index counts = shape_.cells;
    for (int axis = 0; axis < shape_.dimension; ++axis)
      counts[axis] += closed(axis) ? 0 : 1;
    return counts;
  }
  int number(const Index &at) const {
    const Index counts = vertices();
    int result = 0;
    for (int axis = shape_.dimension; axis-- > 0;)
      result = result * counts[axis] + at[axis] % counts[axis];
    return result;
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
    const Eigen::Map<const Eigen::VectorXd> size(shape_.size.data(), shape_.dimension);
    Eigen::VectorXd x = s.cwiseProduct(size);
    if (shape_.ring) {
      const double radius = size[0] + s[0] * (size[1] - size[0]), turn = 2 * std::numbers::pi;
      x.head(2) << radius * std::cos(turn * s[1]), radius * std::sin(turn * s[1]);
    }
    return x;
  }

 private:
  const MeshShape &shape_;
};

// All indices below `counts`, the first axis fastest.
std::vector<Index> all_below(const Index &counts) {
  std::vector<Index> all;
  Index at(counts.size(), 0);
  for (std::size_t axis = 0; axis < counts.size();) {
    all.push_back(at);
    for (axis = 0; axis < counts.size() && ++at[axis] == counts[axis]; ++axis)
      at[axis] = 0;
  }
  return all;
}

Index sum(Index a, const Index &b) {
  std::transform(a.begin(), a.end(), b.begin(), a.begin(), std::plus());
  return a;
}

// Kuhn's simplices: one for each order in which the axes lead from the first corner to the last.
std::vector<std::vector<Index>> simplices_at(const Index &first) {
  std::vector<std::vector<Index>> all;
  Index axes(first.size());
  std::iota(axes.begin(), axes.end(), 0);
  do {
    all.push_back({first});
    for (const int axis : axes) {
      all.back().push_back(all.back().back());
      ++all.back().back()[axis];
    }
  } while (std::next_permutation(axes.begin(), axes.end()));
  return all;
}

std::vector<std::vector<Index>> cells_at(const Index &first, bool simplices) {
  if (simplices)
    return simplices_at(first);
  std::vector<Index> corners = all_below(Index(first.size(), 2));
  for (Index &corner : corners)
    corner = sum(corner, first);
  return {corners};
}

// Of corners with the first axis fastest; of simplices any order is right.
std::vector<int> in_order_of_gmsh(std::vector<int> corners) {
  for (std::size_t i = 3; i < corners.size(); i += 4)
    std::swap(corners[i - 1], corners[i]);
  return corners;
}

std::vector<int> numbers(const Grid &grid, const std::vector<Index> &corners, int side = -1) {
  std::vector<int> all;
  for (const Index &corner : corners)
    if (side < 0 || grid.ends(corner, side))
      all.push_back(grid.number(corner));
  return in_order_of_gmsh(all);
}

}  // namespace

SampleMesh random_mesh(const MeshShape &shape, Random &random) {
  const Grid grid(shape);
  SampleMesh mesh;
  mesh.simplices = shape.simplices;
  for (const Index &at : all_below(grid.vertices()))
    mesh.points.push_back(grid.place(at, random));
  const int axis = shape.layered / 2, n = shape.cells[axis];
  const int facet = shape.simplices ? shape.dimension : 1 << (shape.dimension - 1);
  for (const Index &at : all_below(shape.cells)) {
    const int depth = shape.layered % 2 == 0 ? at[axis] : n - 1 - at[axis];
    for (const auto &corners : cells_at(at, shape.simplices)) {
      mesh.cells.push_back(numbers(grid, corners));
      mesh.region.push_back(shape.regions == 2 && 2 * depth + 1 > n ? 1 : 0);
      for (int side = 0; side < 2 * shape.dimension; ++side)
        if (const auto on_side = numbers(grid, corners, side); int(on_side.size()) == facet) {
          mesh.facets.push_back(on_side);
          mesh.side.push_back(side);
        }
    }
  }
  return mesh;
}

}  // namespace tourmaline::verified
