#include "body/derived.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "dense/decompositions.h"
#include "gradients.h"
#include "parallel/ranks.h"

namespace tourmaline::body {

material::Voigt strain_of(const Gradients &at) {
  const Eigen::Matrix3d &h = at.displacement;
  material::Voigt strain;
  strain << h(0, 0), h(1, 1), h(2, 2), h(1, 2) + h(2, 1), h(0, 2) + h(2, 0), h(0, 1) + h(1, 0);
  return strain;
}

void add_strains_across(material::Plane plane, const material::Constants &c, Gradients &at) {
  if (plane != material::Plane::stress)
    return;
  const Eigen::Vector3d across =
      material::strains_across(c, strain_of(at), -at.potential, at.theta);
  at.displacement(2, 2) = across[0];
  at.displacement(1, 2) = across[1];
  at.displacement(0, 2) = across[2];
}

material::Voigt stress_of(const Gradients &at, const material::Constants &c) {
  return c.stiffness * strain_of(at) + c.piezoelectric.transpose() * at.potential -
         c.thermal_stress * at.theta;
}

output::SymmetricTensor in_file_order(const material::Voigt &v, double shear) {
  return {v[0], v[1], v[2], shear * v[5], shear * v[3], shear * v[4]};
}

Vector3 principal_stresses(const output::SymmetricTensor &s) {
  Eigen::Matrix3d stress;
  stress << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
  const Eigen::Vector3d ascending = dense::eigenvalues(stress);
  return {ascending[2], ascending[1], ascending[0]};
}

double von_mises(const output::SymmetricTensor &s) {
  const double xy = s[0] - s[1], yz = s[1] - s[2], zx = s[2] - s[0];
  return std::sqrt((xy * xy + yz * yz + zx * zx) / 2 +
                   3 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]));
}

namespace {

Vector3 plain(const Eigen::Vector3d &v) {
  return {v[0], v[1], v[2]};
}

template <int dim>
Gradients means(const Quadrature<dim> &cell, std::span<const double> state) {
  const double volume = std::accumulate(cell.jxw.begin(), cell.jxw.end(), 0.);
  Gradients means;
  for (std::size_t q = 0; q < cell.jxw.size(); ++q)
    add_gradients(cell, q, state, cell.jxw[q] / volume, means);
  return means;
}

void add_fields(const Gradients &m, const material::Constants &c, output::CellFields &fields) {
  const material::Voigt strain = strain_of(m);
  fields.strain.push_back(in_file_order(strain, 0.5));
  fields.stress.push_back(in_file_order(stress_of(m, c), 1));
  fields.principal_stress.push_back(principal_stresses(fields.stress.back()));
  fields.von_mises.push_back(von_mises(fields.stress.back()));
  fields.electric_field.push_back(plain(-m.potential));
  // (2) with E = -grad phi, (3).
  fields.electric_displacement.push_back(
      plain(c.piezoelectric * strain - c.permittivity * m.potential + c.pyroelectric * m.theta));
  fields.heat_flux.push_back(plain(-c.conductivity * m.temperature));
}

struct StrainedCell {
  double strain;  // the largest principal one
  Vector3 centre;
};

constexpr double nearly = 1 - 1e-6;

}  // namespace

// Of cells that have it but for round-off, the first by place: so it does not depend on the ranks.
template <int dim>
LargestStrain largest_strain(const Discretisation<dim> &body, std::span<const double> state) {
  std::vector<StrainedCell> cells;  // those that may have it
  LargestStrain found;
  body.for_each_cell([&](const Quadrature<dim> &cell) {
    const Eigen::Matrix3d gradient = means(cell, state).displacement;
    const Eigen::Matrix3d strain = (gradient + gradient.transpose()) / 2;
    if (strain.norm() < nearly * found.size)  // no eigenvalue is larger than that
      return;
    const double largest = dense::eigenvalues(strain).cwiseAbs().maxCoeff();
    if (largest < nearly * found.size)
      return;
    found.size = std::max(found.size, largest);
    cells.push_back({largest, cell.centre()});
  });
  parallel::largest({&found.size, 1});
  std::vector<double> places;
  for (const StrainedCell &cell : cells)
    if (!(cell.strain < nearly * found.size))
      places.insert(places.end(), cell.centre.begin(), cell.centre.end());
  places = parallel::joined(places);
  for (std::size_t at = 0; at < places.size(); at += 3)
    if (const Vector3 place{places[at], places[at + 1], places[at + 2]};
        at == 0 || place < found.at)
      found.at = place;
  return found;
}

template LargestStrain largest_strain<2>(const Discretisation<2> &, std::span<const double>);
template LargestStrain largest_strain<3>(const Discretisation<3> &, std::span<const double>);

template <int dim>
output::CellFields derived_fields(const Discretisation<dim> &body,
                                  const material::Composition<dim> &composition,
                                  std::span<const double> state) {
  output::CellFields fields;
  const bool varies = composition.varies(), polar = composition.is_polar();
  body.for_each_cell([&](const Quadrature<dim> &cell) {
    const std::array<double, 3> centre = cell.centre();
    const material::Constants constants = composition.in_space(cell.region, centre);
    Gradients mean = means(cell, state);
    add_strains_across(composition.plane(), constants, mean);
    add_fields(mean, constants, fields);
    if (varies)
      fields.region.push_back(static_cast<double>(cell.region));
    if (varies || polar)
      fields.poling.push_back(plain(composition.poling(cell.region, centre)));
  });
  return fields;
}

template <int dim>
output::CellFields derived_fields(const Discretisation<dim> &body, const material::Constants &c,
                                  std::span<const double> state) {
  output::CellFields fields;
  body.for_each_cell(
      [&](const Quadrature<dim> &cell) { add_fields(means(cell, state), c, fields); });
  return fields;
}

template output::CellFields derived_fields<2>(const Discretisation<2> &,
                                              const material::Composition<2> &,
                                              std::span<const double>);
template output::CellFields derived_fields<3>(const Discretisation<3> &,
                                              const material::Composition<3> &,
                                              std::span<const double>);
template output::CellFields derived_fields<2>(const Discretisation<2> &,
                                              const material::Constants &, std::span<const double>);
template output::CellFields derived_fields<3>(const Discretisation<3> &,
                                              const material::Constants &, std::span<const double>);

}  // namespace tourmaline::body
