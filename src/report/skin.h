#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "output/records.h"

namespace tourmaline::report {

/// What of a grid can be seen, as flat triangles: all of it in 2D, its surface in 3D. Quadratic
/// cells are split at their mid-side nodes, so that curved sides stay curved.
struct Skin {
  std::vector<std::uint32_t> nodes;                     ///< points of the grid, ascending
  std::vector<std::uint32_t> names;                     ///< rows of nodes.csv of these
  std::vector<std::uint32_t> cells;                     ///< of the grid, ascending
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< places in `nodes`; outward in 3D
  std::vector<std::uint32_t> triangle_cells;            ///< places in `cells`
  std::vector<std::array<std::uint32_t, 2>> edges;      ///< sides of cells; places in `nodes`
  std::size_t n_facets = 0;  ///< of the whole boundary: sides of plane cells, faces of solid ones
};

/// Of each point the first one at its place, whose row of nodes.csv is theirs.
std::vector<std::uint32_t> node_names(const std::vector<Vector3> &points);

/// Points at one place, of which there is one for each region that meets there, belong to one node:
/// the first of them has its number.
Skin skin_of(const output::Grid &grid);

}  // namespace tourmaline::report
