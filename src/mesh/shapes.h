#pragma once

#include "mesh/mesh.h"

/// The shapes that a case can describe without a mesh file, and what is in one.
namespace tourmaline::mesh {

template <int dim>
Mesh<dim> box(const casefile::Box &asked);

template <int dim>
Mesh<dim> annulus(const casefile::Annulus &asked);

template <int dim>
Mesh<dim> imported(const casefile::MeshFile &file);

}  // namespace tourmaline::mesh
