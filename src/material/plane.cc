#include "material/plane.h"

#include <cmath>

#include "tourmaline/error.h"

namespace tourmaline::material {

namespace {

// Voigt places of xx, yy, xy and of the strains that plane strain sets to zero although the plane
// could drive them: yz, xz.
const std::array<int, 3> in_plane{0, 1, 5};
const std::array<int, 2> out_of_plane{3, 4};

void check_plane(const Constants &c) {
  const double stress = c.stiffness.cwiseAbs().maxCoeff();
  const double charge = c.piezoelectric.cwiseAbs().maxCoeff();
  const double heat = c.thermal_stress.cwiseAbs().maxCoeff();
  bool couples = false;
  for (const int out : out_of_plane) {
    for (const int in : in_plane)
      couples |= std::abs(c.stiffness(out, in)) > 1e-10 * stress;
    for (const int k : {0, 1})
      couples |= std::abs(c.piezoelectric(k, out)) > 1e-10 * charge;
    couples |= std::abs(c.thermal_stress(out)) > 1e-10 * heat;
  }
  if (couples)
    throw CaseError(
        "[material] in this orientation fields in the plane drive a displacement out of it, so "
        "plane "
        "strain is no solution; turn poling into the plane, or model the body in three dimensions");
}

}  // namespace

template <>
BodyConstants<3> restricted<3>(const Constants &c) {
  return {c.stiffness,    c.piezoelectric,     c.permittivity,    c.thermal_stress,
          c.pyroelectric, c.conductivity,      c.heat_capacity(), c.reference_temperature,
          c.density,      c.stiffness_damping, c.mass_damping};
}

template <>
BodyConstants<2> restricted<2>(const Constants &c) {
  check_plane(c);
  return {c.stiffness(in_plane, in_plane),
          c.piezoelectric(std::array{0, 1}, in_plane),
          c.permittivity.topLeftCorner<2, 2>(),
          c.thermal_stress(in_plane),
          c.pyroelectric.head<2>(),
          c.conductivity.topLeftCorner<2, 2>(),
          c.heat_capacity(),
          c.reference_temperature,
          c.density,
          c.stiffness_damping,
          c.mass_damping};
}

}  // namespace tourmaline::material
