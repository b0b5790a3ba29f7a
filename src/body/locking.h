#pragma once

#include <span>

#include "body/operator.h"

namespace tourmaline::body {

/// The energy that linear cells hold only because they cannot follow a bent body, as a share of the
/// body's energies, each between 0 and 1.
struct LockedShare {
  /// of 1/2 int F eps.eps: about 1 - 1/r where loads bend the body and it is r times too stiff
  double of_strain = 0;
  /// of 1/2 int F^-1 sigma.sigma, in which strains that nothing hinders do not count, as those of
  /// the field across a bending layer
  double of_stress = 0;
};

/// Quadrilaterals and hexahedra: the energy that incompatible modes of u would release. Triangles
/// and tetrahedra: that of the difference between the cells' strains and those recovered at the
/// nodes, inside each region (O. C. Zienkiewicz, J. Z. Zhu, Int. J. Numer. Meth. Eng. 24 (1987)
/// 337-357). None for degree 2. `state` is one of the whole body without incompatible modes; all
/// ranks ask together.
template <int dim>
LockedShare locked_share(const Discretisation<dim> &body,
                         const material::Composition<dim> &composition,
                         std::span<const double> state);

/// How slender a body is, and how many of its cells stand in its thickness. The thickness is twice
/// the volume over the surface (2D: the area over the boundary's length) of what has a name.
struct Slenderness {
  /// diagonal of the box around the body over the thickness; 1 for a square or cube, 2 for beams
  /// five times as long as thick
  double ratio = 0;
  double cells = 0;  ///< thickness over the mean size of the cells
};

/// All ranks ask together.
template <int dim>
Slenderness slenderness(const Discretisation<dim> &body);

}  // namespace tourmaline::body
