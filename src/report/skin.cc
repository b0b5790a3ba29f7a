#include "report/skin.h"

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>

namespace tourmaline::report {
namespace {

using output::VtkCell;
using Local = std::vector<unsigned int>;

/// The faces of a cell by its local nodes: corners in a circle, then the nodes amid the sides that
/// follow the corners, then the one amid the face. A plane cell is its own face.
const std::vector<Local> &faces_of(VtkCell cell) {
  static const std::map<VtkCell, std::vector<Local>> faces{
      {VtkCell::triangle, {{0, 1, 2}}},
      {VtkCell::quadrilateral, {{0, 1, 2, 3}}},
      {VtkCell::quadratic_triangle, {{0, 1, 2, 3, 4, 5}}},
      {VtkCell::quadratic_quadrilateral, {{0, 1, 2, 3, 4, 5, 6, 7, 8}}},
      {VtkCell::tetrahedron, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}},
      {VtkCell::hexahedron,
       {{0, 4, 7, 3}, {1, 2, 6, 5}, {0, 1, 5, 4}, {3, 7, 6, 2}, {0, 3, 2, 1}, {4, 5, 6, 7}}},
      {VtkCell::quadratic_tetrahedron,
       {{0, 2, 1, 6, 5, 4}, {0, 1, 3, 4, 8, 7}, {1, 2, 3, 5, 9, 8}, {0, 3, 2, 7, 9, 6}}},
      {VtkCell::quadratic_hexahedron,
       {{0, 4, 7, 3, 16, 15, 19, 11, 20},
        {1, 2, 6, 5, 9, 18, 13, 17, 21},
        {0, 1, 5, 4, 8, 17, 12, 16, 22},
        {3, 7, 6, 2, 19, 14, 18, 10, 23},
        {0, 3, 2, 1, 11, 10, 9, 8, 24},
        {4, 5, 6, 7, 12, 13, 14, 15, 25}}}};
  return faces.at(cell);
}

/// Triangles of a face with that many nodes, by their places in the face's list.
const std::vector<std::array<unsigned int, 3>> &triangles_of(std::size_t nodes) {
  static const std::map<std::size_t, std::vector<std::array<unsigned int, 3>>> triangles{
      {3, {{0, 1, 2}}},
      {4, {{0, 1, 2}, {0, 2, 3}}},
      {6, {{0, 3, 5}, {3, 1, 4}, {4, 2, 5}, {3, 4, 5}}},
      {9,
       {{0, 4, 8}, {4, 1, 8}, {1, 5, 8}, {5, 2, 8}, {2, 6, 8}, {6, 3, 8}, {3, 7, 8}, {7, 0, 8}}}};
  return triangles.at(nodes);
}

std::size_t corners_of(std::size_t nodes) {
  return nodes == 3 || nodes == 6 ? 3 : 4;
}

struct Face {
  std::uint32_t cell;
  std::vector<std::uint32_t> nodes;
};

using Corners = std::array<std::uint32_t, 4>;

/// Regions that meet at a face have points of their own there.
Corners key_of(const Face &face, const std::vector<std::uint32_t> &names) {
  Corners key;
  key.fill(std::numeric_limits<std::uint32_t>::max());  // of a triangle's fourth
  for (std::size_t i = 0; i < corners_of(face.nodes.size()); ++i)
    key[i] = names[face.nodes[i]];
  std::sort(key.begin(), key.end());
  return key;
}

std::vector<Face> all_faces(const output::Grid &grid) {
  std::vector<Face> faces;
  for (std::size_t c = 0; c < grid.n_cells(); ++c)
    for (const Local &local : faces_of(grid.cell)) {
      Face face{static_cast<std::uint32_t>(c), {}};
      for (const unsigned int a : local)
        face.nodes.push_back(grid.connectivity[c * grid.nodes_per_cell + a]);
      faces.push_back(std::move(face));
    }
  return faces;
}

/// Those that belong to one cell only, in the order of the cells.
std::vector<Face> outer(const std::vector<Face> &faces, const std::vector<std::uint32_t> &names) {
  std::vector<std::pair<Corners, std::size_t>> keys;
  keys.reserve(faces.size());
  for (std::size_t i = 0; i < faces.size(); ++i)
    keys.emplace_back(key_of(faces[i], names), i);
  std::sort(keys.begin(), keys.end());
  std::vector<std::size_t> single;
  for (std::size_t i = 0; i < keys.size(); ++i)
    if ((i == 0 || keys[i - 1].first != keys[i].first) &&
        (i + 1 == keys.size() || keys[i + 1].first != keys[i].first))
      single.push_back(keys[i].second);
  std::sort(single.begin(), single.end());
  std::vector<Face> result;
  result.reserve(single.size());
  for (const std::size_t i : single)
    result.push_back(faces[i]);
  return result;
}

/// Sides that belong to one plane cell only.
std::size_t outer_sides(const std::vector<Face> &cells, const std::vector<std::uint32_t> &names) {
  std::map<std::array<std::uint32_t, 2>, int> cells_at;
  for (const Face &cell : cells) {
    const std::size_t n = corners_of(cell.nodes.size());
    for (std::size_t i = 0; i < n; ++i) {
      const std::uint32_t a = names[cell.nodes[i]], b = names[cell.nodes[(i + 1) % n]];
      ++cells_at[{std::min(a, b), std::max(a, b)}];
    }
  }
  return std::count_if(cells_at.begin(), cells_at.end(),
                       [](const auto &side) { return side.second == 1; });
}

void sort_once(std::vector<std::uint32_t> &numbers) {
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

std::uint32_t place_in(const std::vector<std::uint32_t> &sorted, std::uint32_t number) {
  return static_cast<std::uint32_t>(std::lower_bound(sorted.begin(), sorted.end(), number) -
                                    sorted.begin());
}

void add_sides(Skin &skin, const std::vector<std::uint32_t> &nodes) {
  const std::size_t n = corners_of(nodes.size());
  const bool quadratic = nodes.size() > 4;
  const auto add = [&](std::uint32_t a, std::uint32_t b) {
    skin.edges.push_back({std::min(a, b), std::max(a, b)});
  };
  for (std::size_t i = 0; i < n; ++i) {
    const std::uint32_t a = nodes[i], b = nodes[(i + 1) % n];
    if (!quadratic) {
      add(a, b);
      continue;
    }
    add(a, nodes[n + i]);
    add(nodes[n + i], b);
  }
}

}  // namespace

std::vector<std::uint32_t> node_names(const std::vector<Vector3> &points) {
  std::vector<std::uint32_t> order(points.size()), names(points.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return points[a] != points[b] ? points[a] < points[b] : a < b;
  });
  for (std::size_t i = 0; i < order.size(); ++i)
    names[order[i]] =
        i > 0 && points[order[i]] == points[order[i - 1]] ? names[order[i - 1]] : order[i];
  return names;
}

Skin skin_of(const output::Grid &grid) {
  std::vector<Face> faces = all_faces(grid);
  const std::vector<std::uint32_t> names = node_names(grid.points);
  if (grid.dimension == 3)
    faces = outer(faces, names);
  Skin skin;
  skin.n_facets = grid.dimension == 3 ? faces.size() : outer_sides(faces, names);
  for (const Face &face : faces) {
    skin.nodes.insert(skin.nodes.end(), face.nodes.begin(), face.nodes.end());
    skin.cells.push_back(face.cell);
  }
  sort_once(skin.nodes);
  for (const std::uint32_t node : skin.nodes)
    skin.names.push_back(names[node]);
  sort_once(skin.cells);
  for (Face &face : faces) {
    for (std::uint32_t &node : face.nodes)
      node = place_in(skin.nodes, node);
    for (const auto &t : triangles_of(face.nodes.size())) {
      skin.triangles.push_back({face.nodes[t[0]], face.nodes[t[1]], face.nodes[t[2]]});
      skin.triangle_cells.push_back(place_in(skin.cells, face.cell));
    }
    add_sides(skin, face.nodes);
  }
  std::sort(skin.edges.begin(), skin.edges.end());
  skin.edges.erase(std::unique(skin.edges.begin(), skin.edges.end()), skin.edges.end());
  return skin;
}

}  // namespace tourmaline::report
