#pragma once

#include "mesh/mesh.h"

namespace tourmaline::mesh {

/// Shares the cells of a mesh, which every rank holds as a whole, out to the ranks (METIS); each
/// keeps its own and a layer around them. On one rank nothing changes.
template <int dim>
void distribute(Mesh<dim> &mesh);

}  // namespace tourmaline::mesh
