#include "report/solid.h"

#include <map>

namespace tourmaline::report {
namespace {

using output::VtkCell;
using Local = std::vector<unsigned int>;

std::vector<Local> eighths_of_hexahedron() {
  // Nodes of a triquadratic cell in rows along x, rows along y, layers along z.
  constexpr unsigned int lattice[27] = {0,  8,  1,  11, 24, 9,  3, 10, 2,  16, 22, 17, 20, 26,
                                        21, 19, 23, 18, 4,  12, 5, 15, 25, 13, 7,  14, 6};
  std::vector<Local> parts;
  for (const int first : {0, 1, 3, 4, 9, 10, 12, 13}) {
    Local part;
    for (const int step : {0, 1, 4, 3, 9, 10, 13, 12})
      part.push_back(lattice[first + step]);
    parts.push_back(part);
  }
  return parts;
}

/// Linear cells that fill a cell, by its local nodes.
const std::vector<Local> &parts_of(VtkCell cell) {
  static const std::map<VtkCell, std::vector<Local>> parts{
      {VtkCell::tetrahedron, {{0, 1, 2, 3}}},
      {VtkCell::hexahedron, {{0, 1, 2, 3, 4, 5, 6, 7}}},
      {VtkCell::quadratic_tetrahedron,
       {{0, 4, 6, 7},
        {4, 1, 5, 8},
        {6, 5, 2, 9},
        {7, 8, 9, 3},
        {6, 8, 4, 5},
        {6, 8, 5, 9},
        {6, 8, 9, 7},
        {6, 8, 7, 4}}},
      {VtkCell::quadratic_hexahedron, eighths_of_hexahedron()}};
  return parts.at(cell);
}

/// Numbers from 0 to `count` that are not in `taken`, and of every number its place: `taken` first,
/// then the others, both ascending.
struct Order {
  std::vector<std::uint32_t> others, place;

  Order(std::size_t count, const std::vector<std::uint32_t> &taken) : place(count) {
    std::size_t next = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
      const bool is_taken = next < taken.size() && taken[next] == i;
      place[i] = static_cast<std::uint32_t>(is_taken ? next++ : taken.size() + others.size());
      if (!is_taken)
        others.push_back(i);
    }
  }
};

}  // namespace

Solid solid_of(const output::Grid &grid, const Skin &skin) {
  const Order nodes(grid.points.size(), skin.nodes), cells(grid.n_cells(), skin.cells);
  const std::vector<std::uint32_t> names = node_names(grid.points);
  Solid solid;
  solid.nodes = nodes.others;
  solid.cells = cells.others;
  for (const std::uint32_t node : solid.nodes) {
    solid.names.push_back(names[node]);
    solid.points.push_back(grid.points[node]);
  }
  solid.corners = parts_of(grid.cell).front().size();
  for (std::size_t c = 0; c < grid.n_cells(); ++c)
    for (const Local &part : parts_of(grid.cell)) {
      solid.part_cells.push_back(cells.place[c]);
      for (const unsigned int corner : part)
        solid.parts.push_back(nodes.place[grid.connectivity[c * grid.nodes_per_cell + corner]]);
    }
  return solid;
}

}  // namespace tourmaline::report
