#pragma once

#include <deal.II/grid/tria.h>

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "tourmaline/case/mesh_case.h"

namespace tourmaline::casefile {
struct Case;
}

namespace tourmaline::mesh {

/// Places of a facet's corners [m], sorted.
template <int dim>
using FacetCorners = std::vector<std::array<double, dim>>;

template <int dim, class Face>
FacetCorners<dim> corners_of(const Face &face) {
  FacetCorners<dim> corners;
  for (const unsigned int vertex : face.vertex_indices()) {
    std::array<double, dim> &corner = corners.emplace_back();
    for (unsigned int axis = 0; axis < dim; ++axis)
      corner[axis] = face.vertex(vertex)[axis];
  }
  std::sort(corners.begin(), corners.end());
  return corners;
}

/// Cells of one shape and the boundaries by their names. A facet has one id, but may have several
/// names: a name stands for a set of ids.
template <int dim>
struct Mesh {
  std::unique_ptr<dealii::Triangulation<dim>> cells;
  std::map<std::string, std::set<dealii::types::boundary_id>> boundaries;
  /// Names some of whose facets lie between cells, with all of their facets. These go by their
  /// corners, as deal.II has ids on the boundary alone.
  std::map<std::string, std::set<FacetCorners<dim>>> inner;
  bool simplices = false;
};

/// The mesh that a case asks for: a shape, or what was read from its mesh file.
template <int dim>
Mesh<dim> build(const casefile::MeshCase &asked);

/// The same with the cells assigned to the case's regions: a cell's material id is the index of its
/// region, 0 when the case has none. Throws CaseError for a cell in none or in several.
template <int dim>
Mesh<dim> build(const casefile::Case &asked);
/// Assigns the cells of a mesh; by the names in `file`, if there is one.
template <int dim>
void assign_regions(Mesh<dim> &mesh, const casefile::Case &asked);

}  // namespace tourmaline::mesh
