#pragma once

#include <cstdint>
#include <vector>

#include "output/records.h"
#include "report/skin.h"

namespace tourmaline::report {

/// What of a solid body lies behind its skin, so that it can be cut. Nodes and cells are numbered
/// on from those of the skin.
struct Solid {
  std::vector<std::uint32_t> nodes;  ///< points of the grid that are not the skin's, ascending
  std::vector<std::uint32_t> names;  ///< rows of nodes.csv of these
  std::vector<Vector3> points;       ///< [m]
  std::vector<std::uint32_t> cells;  ///< of the grid that are not the skin's, ascending
  std::size_t corners = 4;           ///< of each part, 8 if they are hexahedra
  std::vector<std::uint32_t> parts;  ///< corners of linear parts of all cells, in VTK's order
  std::vector<std::uint32_t> part_cells;
};

/// Quadratic cells are split at their mid-side nodes, as those of the skin are.
Solid solid_of(const output::Grid &grid, const Skin &skin);

}  // namespace tourmaline::report
