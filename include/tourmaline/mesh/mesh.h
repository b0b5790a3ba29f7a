#pragma once

#include <deal.II/grid/tria.h>

#include <map>
#include <memory>
#include <string>

#include "tourmaline/case/case.h"

namespace tourmaline::mesh {

/// Cells of one shape and the boundaries by their names.
template <int dim>
struct Mesh {
  std::unique_ptr<dealii::Triangulation<dim>> cells;
  std::map<std::string, dealii::types::boundary_id> boundaries;
  bool simplices = false;
};

/// The mesh that a case asks for. Throws CaseError when there is none of that kind.
template <int dim>
Mesh<dim> build(const casefile::MeshCase &asked);

}  // namespace tourmaline::mesh
