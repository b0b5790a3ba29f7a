#include "material/orientation.h"

#include <fmt/format.h>

#include "tourmaline/case/material_case.h"
#include "tourmaline/error.h"

namespace tourmaline::material {

namespace {

Vector direction(const std::vector<double> &given, const Vector &otherwise, const char *key,
                 int dimension, const std::array<double, 3> &place) {
  if (given.empty())
    return otherwise;
  if (static_cast<int>(given.size()) != dimension)
    throw CaseError(fmt::format("[material] {} has {} entries; a direction in {} dimensions has {}",
                                key, given.size(), dimension, dimension));
  Vector v = Vector::Zero();
  std::copy(given.begin(), given.end(), v.data());
  if (!(v.norm() > 0))
    throw CaseError(
        fmt::format("[material] {} is zero at ({:g}, {:g}, {:g}); it must be a direction", key,
                    place[0], place[1], place[2]));
  return v.normalized();
}

std::vector<double> numbers(const casefile::FormulaVector &formulas,
                            const std::array<double, 3> &place) {
  std::vector<double> all;
  for (const casefile::Formula &formula : formulas)
    all.push_back(formula.value(place, 0));
  return all;
}

// In 2D the crystal's axis 2 is the plane's normal, so axis 1 follows from the poling axis alone.
Vector default_axis1(const Vector &axis3, int dimension) {
  if (dimension == 2)
    return Vector(axis3.y(), -axis3.x(), 0);
  const Vector x = Vector::UnitX();
  return std::abs(axis3.dot(x)) < 0.9 ? x : Vector(-Vector::UnitZ());
}

// Bond's matrix: Voigt stress in the body's axes from that in the crystal's.
Stiffness bond(const Tensor &r) {
  constexpr int pair[6][2] = {{0, 0}, {1, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}};
  Stiffness m;
  for (int I = 0; I < 6; ++I)
    for (int J = 0; J < 6; ++J) {
      const auto [i, j] = pair[I];
      const auto [k, l] = pair[J];
      m(I, J) = k == l ? r(i, k) * r(j, k) : r(i, k) * r(j, l) + r(i, l) * r(j, k);
    }
  return m;
}

}  // namespace

Tensor crystal_axes(const casefile::MaterialCase &asked, int dimension,
                    const std::array<double, 3> &place) {
  const Vector up = dimension == 2 ? Vector::UnitY() : Vector::UnitZ();
  const Vector axis3 = direction(numbers(asked.poling, place), up, "poling", dimension, place);
  Vector axis1 = direction(asked.axis1, default_axis1(axis3, dimension), "axis1", dimension, place);
  axis1 -= axis1.dot(axis3) * axis3;
  if (axis1.norm() < 1e-8)
    throw CaseError("[material] axis1 is parallel to poling; it must be another direction");
  axis1.normalize();
  Tensor axes;
  axes << axis1, axis3.cross(axis1), axis3;
  return axes;
}

Constants rotated(const Constants &crystal, const Tensor &rotation) {
  const Stiffness m = bond(rotation);
  Constants body = crystal;
  body.stiffness = m * crystal.stiffness * m.transpose();
  body.piezoelectric = rotation * crystal.piezoelectric * m.transpose();
  body.permittivity = rotation * crystal.permittivity * rotation.transpose();
  body.thermal_stress = m * crystal.thermal_stress;
  body.pyroelectric = rotation * crystal.pyroelectric;
  body.conductivity = rotation * crystal.conductivity * rotation.transpose();
  return body;
}

}  // namespace tourmaline::material
