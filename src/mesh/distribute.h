#pragma once

#include <functional>

#include "mesh/mesh.h"

namespace tourmaline::mesh {

/// The mesh that `make` makes, its cells shared out to the ranks (METIS): each keeps its own and a
/// layer around them. One rank of a group makes it, and no other ever holds it as a whole. An error
/// of `make` is thrown on all ranks. Collective.
template <int dim>
Mesh<dim> shared_out(const std::function<Mesh<dim>()> &make);

}  // namespace tourmaline::mesh
