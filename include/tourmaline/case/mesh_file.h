#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace tourmaline::casefile {

enum class CellShape { triangle, quadrilateral, tetrahedron, hexahedron };

/// Named groups of elements. An element may be in none, in one or in several of them.
struct Groups {
  std::vector<std::string> names;
  /// different sets of indices into `names`, ascending; the first one is empty
  std::vector<std::vector<int>> sets = {{}};
  std::vector<int> set_of;  ///< by element, index into `sets`

  /// Index into `sets`; the set is added when it is new.
  int set_index(const std::vector<int> &members);
  /// Indices into `sets` of those that hold the name.
  std::vector<int> sets_with(const std::string &name) const;
};

/// A mesh as plain arrays: cells of one shape, their vertices in Gmsh's order, and the facets that
/// are on the boundary or have a name.
struct MeshFile {
  int dimension = 2;
  CellShape cell = CellShape::triangle;
  std::vector<std::array<double, 3>> points;  ///< [m]; z = 0 in 2D; each belongs to a cell
  std::vector<std::uint32_t> cells, facets;   ///< vertices, one element behind the other
  Groups regions;                             ///< of the cells
  Groups boundaries;                          ///< of the facets
  std::vector<bool> inside;                   ///< by facet, whether it lies between two cells

  std::size_t vertices_per_cell() const;
  std::size_t vertices_per_facet() const;
  std::size_t n_cells() const { return cells.size() / vertices_per_cell(); }
  std::size_t n_facets() const { return facets.size() / vertices_per_facet(); }

  /// Names all of whose facets are on the boundary, and the others.
  std::vector<std::string> boundary_names() const;
  std::vector<std::string> inner_names() const;
};

struct MeshCase;
/// Reads what `mesh.file` names. Throws CaseError with what is wrong with the file.
using MeshFileReader = std::function<std::shared_ptr<const MeshFile>(const MeshCase &)>;

}  // namespace tourmaline::casefile
