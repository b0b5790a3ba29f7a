#pragma once

#include "tourmaline/mesh/mesh.h"

/// The shapes that a case can describe without a mesh file.
namespace tourmaline::mesh {

template <int dim>
Mesh<dim> box(const casefile::Box &asked);

template <int dim>
Mesh<dim> annulus(const casefile::Annulus &asked);

}  // namespace tourmaline::mesh
