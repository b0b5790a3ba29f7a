#include "tourmaline/material/constants.h"

#include <fmt/format.h>

#include <cmath>

#include "tourmaline/error.h"
#include "tourmaline/material/library.h"

namespace tourmaline::material {

namespace {

using Named = std::map<std::string, double>;

double need(const Named &named, const char *constant) {
  const auto found = named.find(constant);
  if (found == named.end())
    throw CaseError(
        fmt::format("[material] {} is missing: give it, or a library entry that has it "
                    "(`tourmaline materials` lists them)",
                    constant));
  return found->second;
}

double or_zero(const Named &named, const char *constant) {
  const auto found = named.find(constant);
  return found == named.end() ? 0 : found->second;
}

// Class 6mm: five elastic constants, c66 = (c11 - c12) / 2.
Stiffness hexagonal_stiffness(const Named &named) {
  const double c11 = need(named, "c11"), c12 = need(named, "c12"), c13 = need(named, "c13");
  const double c33 = need(named, "c33"), c44 = need(named, "c44");
  Stiffness c = Stiffness::Zero();
  c.topLeftCorner<3, 3>() << c11, c12, c13, c12, c11, c13, c13, c13, c33;
  c.diagonal().tail<3>() << c44, c44, (c11 - c12) / 2;
  return c;
}

Piezoelectric hexagonal_piezoelectric(const Named &named) {
  const double e31 = or_zero(named, "e31"), e33 = or_zero(named, "e33");
  const double e15 = or_zero(named, "e15");
  Piezoelectric e = Piezoelectric::Zero();
  e(0, 4) = e(1, 3) = e15;
  e.row(2).head<3>() << e31, e31, e33;
  return e;
}

Tensor about_axis3(double across, double along) {
  return Vector(across, across, along).asDiagonal();
}

Stiffness matrix66(const std::vector<std::vector<double>> &rows) {
  Stiffness m;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j)
      m(i, j) = rows.at(i).at(j);
  return m;
}

Piezoelectric matrix36(const std::vector<std::vector<double>> &rows) {
  Piezoelectric m;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 6; ++j)
      m(i, j) = rows.at(i).at(j);
  return m;
}

Tensor matrix33(const std::vector<std::vector<double>> &rows) {
  Tensor m;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      m(i, j) = rows.at(i).at(j);
  return m;
}

// (p1, p3) in two dimensions, where the plane is the crystal's 1-3 plane; all three otherwise.
Vector pyroelectric_of(const std::vector<double> &p) {
  return p.size() == 2 ? Vector(p[0], 0, p[1]) : Vector(p.at(0), p.at(1), p.at(2));
}

template <typename Matrix>
void need_positive(const Matrix &matrix, const char *name) {
  const double size = matrix.cwiseAbs().maxCoeff();
  if ((matrix - matrix.transpose()).cwiseAbs().maxCoeff() > 1e-12 * size)
    throw CaseError(fmt::format("[material] {} is not symmetric", name));
  const Eigen::SelfAdjointEigenSolver<Matrix> spectrum(matrix);
  if (spectrum.eigenvalues()(0) <= 0)
    throw CaseError(
        fmt::format("[material] {} is not positive definite: its smallest eigenvalue is {:.6g}; a "
                    "stored energy "
                    "must be positive for every state",
                    name, spectrum.eigenvalues()(0)));
}

}  // namespace

Constants constants_of(const casefile::MaterialCase &asked) {
  Named named = asked.library ? find(*asked.library).constants : Named{};
  for (const auto &[constant, value] : asked.constants)
    named[constant] = value;

  Constants c;
  c.stiffness = asked.stiffness ? matrix66(*asked.stiffness) : hexagonal_stiffness(named);
  c.piezoelectric =
      asked.piezoelectric ? matrix36(*asked.piezoelectric) : hexagonal_piezoelectric(named);
  c.permittivity = asked.permittivity ? matrix33(*asked.permittivity)
                                      : about_axis3(need(named, "beta11"), need(named, "beta33"));
  c.thermal_stress << or_zero(named, "m11"), or_zero(named, "m11"), or_zero(named, "m33"), 0, 0, 0;
  if (asked.thermal_stress)
    c.thermal_stress = Eigen::Map<const Voigt>(asked.thermal_stress->data());
  c.pyroelectric = asked.pyroelectric ? pyroelectric_of(*asked.pyroelectric)
                                      : Vector(0, 0, or_zero(named, "p3"));
  c.conductivity = asked.conductivity ? matrix33(*asked.conductivity)
                                      : about_axis3(need(named, "k11"), need(named, "k33"));
  c.density = need(named, "density");
  c.specific_heat = need(named, "specific_heat");
  c.reference_temperature = need(named, "reference_temperature");
  check_stored_energy(c);
  return c;
}

void check_stored_energy(const Constants &constants) {
  if (!(constants.heat_capacity() > 0) || !std::isfinite(constants.heat_capacity()))
    throw CaseError("[material] density, specific_heat and reference_temperature must be positive");
  need_positive(constants.stiffness, "stiffness");
  need_positive(constants.permittivity, "permittivity");
  need_positive(constants.conductivity, "conductivity");
  // The electro-thermal part in units in which permittivity and heat capacity are about 1.
  const double volt = 1 / std::sqrt(constants.permittivity.trace() / 3);
  const double kelvin = 1 / std::sqrt(constants.heat_capacity());
  Eigen::Matrix4d energy;
  energy.topLeftCorner<3, 3>() = constants.permittivity * volt * volt;
  energy.topRightCorner<3, 1>() = constants.pyroelectric * volt * kelvin;
  energy.bottomLeftCorner<1, 3>() = energy.topRightCorner<3, 1>().transpose();
  energy(3, 3) = 1;
  need_positive(
      energy,
      "the electro-thermal energy [permittivity pyroelectric; pyroelectric^T rho c_v / theta_ref]");
}

}  // namespace tourmaline::material
