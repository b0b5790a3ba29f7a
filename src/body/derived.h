#pragma once

#include <span>

#include "body/operator.h"
#include "material/constants.h"
#include "output/records.h"

namespace tourmaline::body {

/// Means over each cell of strain, stress (1), E, D (2), q (3) and the von Mises stress of the mean
/// stress, in the order of `Discretisation::grid`. In 2D sigma_zz follows from plane strain and
/// enters von Mises, or eps_zz follows from plane stress. Where materials or poling vary, the
/// region too; then, and where anything is piezo- or pyroelectric, the direction of poling.
template <int dim>
output::CellFields derived_fields(const Discretisation<dim> &body,
                                  const material::Composition<dim> &composition,
                                  std::span<const double> state);
/// The same for one material everywhere, in the axes of the body.
template <int dim>
output::CellFields derived_fields(const Discretisation<dim> &body,
                                  const material::Constants &body_axes,
                                  std::span<const double> state);

/// The greatest size of a principal strain, of the means over each cell, and the centre of the
/// cell.
struct LargestStrain {
  double size = 0;
  Vector3 at{};
};
/// All ranks ask together.
template <int dim>
LargestStrain largest_strain(const Discretisation<dim> &body, std::span<const double> state);

/// The principal stresses, largest first; components as below.
Vector3 principal_stresses(const output::SymmetricTensor &stress);

/// sqrt(3/2 s:s) of the deviator s; components xx, yy, zz, xy, yz, xz.
double von_mises(const output::SymmetricTensor &stress);

}  // namespace tourmaline::body
