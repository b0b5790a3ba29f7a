#pragma once

#include <deal.II/grid/tria.h>

#include <map>
#include <memory>
#include <set>
#include <string>

#include "tourmaline/case/mesh_case.h"

namespace tourmaline::casefile {
struct Case;
}

namespace tourmaline::mesh {

/// Cells of one shape and the boundaries by their names. A facet has one id, but may have several
/// names: a name stands for a set of ids.
template <int dim>
struct Mesh {
  std::unique_ptr<dealii::Triangulation<dim>> cells;
  std::map<std::string, std::set<dealii::types::boundary_id>> boundaries;
  /// Names some of whose facets lie between cells; the ids of these are their manifolds' (all of
  /// which are flat), as deal.II has boundary ids on the boundary alone.
  std::map<std::string, std::set<dealii::types::manifold_id>> inner;
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
