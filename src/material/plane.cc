#include "material/plane.h"

#include <fmt/format.h>

#include <cmath>

#include "tourmaline/error.h"

namespace tourmaline::material {

namespace {

// Voigt places of xx, yy, zz, xy, and without zz; and of the strains that are zero although the
// others could drive them: yz, xz.
constexpr int zz = 2;
const std::array<int, 4> kept{0, 1, 2, 5};
const std::array<int, 3> in_plane{0, 1, 5};
const std::array<int, 2> out_of_plane{3, 4};
// The strains that plane stress leaves free: zz, yz, xz.
const std::array<int, 3> across{2, 3, 4};

void check_plane(const Constants &c, Plane plane) {
  const double stress = c.stiffness.cwiseAbs().maxCoeff();
  const double charge = c.piezoelectric.cwiseAbs().maxCoeff();
  const double heat = c.thermal_stress.cwiseAbs().maxCoeff();
  bool couples = false;
  for (const int out : out_of_plane) {
    for (const int in : kept)
      couples |= std::abs(c.stiffness(out, in)) > 1e-10 * stress &&
                 (in != zz || plane == Plane::axisymmetric);
    for (const int k : {0, 1})
      couples |= std::abs(c.piezoelectric(k, out)) > 1e-10 * charge;
    couples |= std::abs(c.thermal_stress(out)) > 1e-10 * heat;
  }
  if (couples)
    throw CaseError(fmt::format(
        "[material] in this orientation fields in the plane drive a displacement out of it, so "
        "{} is no solution; turn the crystal (poling, axis1) until the plane is one of its planes "
        "of "
        "symmetry, if it has any, or model the body in three dimensions",
        plane == Plane::axisymmetric ? "axial symmetry" : "plane strain"));
}

// With the strains across the plane from (1) without stress there, F_oo eps_o = -F_oi eps_i +
// e_o^T E + m_o theta, put into (1), (2) and the entropy.
BodyConstants<2> without_stress_across(const Constants &c, BodyConstants<2> plane) {
  const Eigen::Matrix3d stiffness = c.stiffness(across, across),
                        coupling = c.stiffness(across, in_plane);
  const Eigen::Matrix<double, 3, 2> piezo = c.piezoelectric(std::array{0, 1}, across).transpose();
  const Eigen::Vector3d thermal = c.thermal_stress(across);
  const Eigen::LLT<Eigen::Matrix3d> factor(stiffness);
  const std::array<int, 3> xx_yy_xy{0, 1, 3};
  const Eigen::Matrix3d stiffness_in_plane = c.stiffness(in_plane, in_plane);
  const double of_zz = plane.stiffness(zz, zz);
  plane.stiffness.setZero();
  plane.stiffness(zz, zz) = of_zz;
  plane.stiffness(xx_yy_xy, xx_yy_xy) =
      stiffness_in_plane - coupling.transpose() * factor.solve(coupling);
  plane.piezoelectric(Eigen::all, xx_yy_xy) -= piezo.transpose() * factor.solve(coupling);
  plane.piezoelectric.col(zz).setZero();
  plane.permittivity += piezo.transpose() * factor.solve(piezo);
  plane.thermal_stress(xx_yy_xy) -= coupling.transpose() * factor.solve(thermal);
  plane.thermal_stress[zz] = 0;
  plane.pyroelectric += piezo.transpose() * factor.solve(thermal);
  plane.heat_capacity += thermal.dot(factor.solve(thermal));
  return plane;
}

}  // namespace

Eigen::Vector3d strains_across(const Constants &c, const Voigt &strain,
                               const Eigen::Vector3d &field, double theta) {
  const Eigen::Matrix3d stiffness = c.stiffness(across, across),
                        coupling = c.stiffness(across, in_plane),
                        piezo = c.piezoelectric(Eigen::all, across);
  const Eigen::Vector3d thermal = c.thermal_stress(across), in = strain(in_plane);
  return stiffness.llt().solve(piezo.transpose() * field + thermal * theta - coupling * in);
}

template <>
BodyConstants<3> restricted<3>(const Constants &c, Plane) {
  return {c.stiffness,    c.piezoelectric,     c.permittivity,    c.thermal_stress,
          c.pyroelectric, c.conductivity,      c.heat_capacity(), c.reference_temperature,
          c.density,      c.stiffness_damping, c.mass_damping};
}

template <>
BodyConstants<2> restricted<2>(const Constants &c, Plane plane) {
  if (plane != Plane::stress)
    check_plane(c, plane);
  const BodyConstants<2> of_plane{c.stiffness(kept, kept),
                                  c.piezoelectric(std::array{0, 1}, kept),
                                  c.permittivity.topLeftCorner<2, 2>(),
                                  c.thermal_stress(kept),
                                  c.pyroelectric.head<2>(),
                                  c.conductivity.topLeftCorner<2, 2>(),
                                  c.heat_capacity(),
                                  c.reference_temperature,
                                  c.density,
                                  c.stiffness_damping,
                                  c.mass_damping};
  return plane == Plane::stress ? without_stress_across(c, of_plane) : of_plane;
}

}  // namespace tourmaline::material
