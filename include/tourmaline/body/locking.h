#pragma once

#include <span>

#include "tourmaline/body/operator.h"

namespace tourmaline::body {

/// How much of the elastic energy linear cells hold only because they cannot follow a bent body,
/// between 0 and 1: about 1 - 1/r where they make the body r times too stiff. Quadrilaterals and
/// hexahedra: the energy that incompatible modes would release, over the elastic energy.
/// Triangles and tetrahedra: the energy of the difference between the cells' strains and those
/// recovered at the nodes, inside each region (Zienkiewicz and Zhu). 0 for degree 2. `state` is one
/// of the whole body without incompatible modes; all ranks ask together.
template <int dim>
double locked_share(const Discretisation<dim> &body, const material::Composition<dim> &composition,
                    std::span<const double> state);

}  // namespace tourmaline::body
