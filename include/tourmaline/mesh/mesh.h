#pragma once

#include <deal.II/grid/tria.h>

#include <map>
#include <memory>
#include <set>
#include <string>

#include "tourmaline/case/case.h"

namespace tourmaline::mesh {

/// Cells of one shape and the boundaries by their names. A facet has one id, but may have several
/// names: a name stands for a set of ids.
template <int dim>
struct Mesh {
  std::unique_ptr<dealii::Triangulation<dim>> cells;
  std::map<std::string, std::set<dealii::types::boundary_id>> boundaries;
  bool simplices = false;
};

/// The mesh that a case asks for: a shape, or what was read from its mesh file.
template <int dim>
Mesh<dim> build(const casefile::MeshCase &asked);

}  // namespace tourmaline::mesh
