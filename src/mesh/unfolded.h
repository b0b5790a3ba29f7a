#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/element_table.h"
#include "tourmaline/case/mesh_file.h"

namespace tourmaline::mesh {

/// Vertices of a cell's facets in Gmsh's numbering; around each of them as seen from outside when
/// the cell is listed in the right order.
const std::vector<std::vector<int>> &facets_of(casefile::CellShape cell);

/// Lists the vertices of every cell in the right order, so that its Jacobian is positive. Throws
/// CaseError for a cell whose Jacobian is not of one sign: flat, folded, not convex.
void orient(casefile::MeshFile &mesh);

/// Throws CaseError where the body overlaps itself: where neighbours lie on the same side of the
/// facet that they share, and where the cells around a vertex (2D) or an edge (3D) fill more than
/// the full angle. `faces` holds the facets of all cells, one behind the other, and `table` finds
/// them; the cells are oriented.
void check_unfolded(const casefile::MeshFile &mesh, std::span<const std::uint32_t> faces,
                    const ElementTable &table);

}  // namespace tourmaline::mesh
