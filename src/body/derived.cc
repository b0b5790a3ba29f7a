#include "tourmaline/body/derived.h"

#include <cmath>

namespace tourmaline::body {

namespace {

// Means over one cell in three dimensions: the gradients that (1)-(3) need.
struct Means {
  Eigen::Matrix3d displacement_gradient = Eigen::Matrix3d::Zero();
  Eigen::Vector3d potential_gradient = Eigen::Vector3d::Zero();
  Eigen::Vector3d temperature_gradient = Eigen::Vector3d::Zero();
  double temperature = 0;
};

template <int dim>
Means means(const Quadrature<dim> &cell, std::span<const double> state) {
  Means m;
  double volume = 0;
  for (std::size_t q = 0; q < cell.jxw.size(); ++q) {
    volume += cell.jxw[q];
    for (std::size_t a = 0; a < cell.nodes.size(); ++a) {
      const double *x = &state[unknown<dim>(cell.nodes[a], 0)];
      const double theta = x[Fields<dim>::temperature], phi = x[Fields<dim>::potential];
      Eigen::Vector3d g = Eigen::Vector3d::Zero();
      for (int i = 0; i < dim; ++i)
        g[i] = cell.jxw[q] * cell.gradient(q, a)[i];
      for (int c = 0; c < dim; ++c)
        m.displacement_gradient.row(c) += x[c] * g.transpose();
      m.potential_gradient += phi * g;
      m.temperature_gradient += theta * g;
      m.temperature += cell.jxw[q] * cell.value(q, a) * theta;
    }
  }
  m.displacement_gradient /= volume;
  m.potential_gradient /= volume;
  m.temperature_gradient /= volume;
  m.temperature /= volume;
  return m;
}

material::Voigt voigt_strain(const Eigen::Matrix3d &h) {
  material::Voigt strain;
  strain << h(0, 0), h(1, 1), h(2, 2), h(1, 2) + h(2, 1), h(0, 2) + h(2, 0), h(0, 1) + h(1, 0);
  return strain;
}

// From Voigt's order 11 22 33 23 13 12 to that of the files, xx yy zz xy yz xz.
output::SymmetricTensor in_file_order(const material::Voigt &v, double shear) {
  return {v[0], v[1], v[2], shear * v[5], shear * v[3], shear * v[4]};
}

output::Vector plain(const Eigen::Vector3d &v) {
  return {v[0], v[1], v[2]};
}

}  // namespace

double von_mises(const output::SymmetricTensor &s) {
  const double xy = s[0] - s[1], yz = s[1] - s[2], zx = s[2] - s[0];
  return std::sqrt((xy * xy + yz * yz + zx * zx) / 2 +
                   3 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]));
}

namespace {

void add_fields(const Means &m, const material::Constants &c, output::CellFields &fields) {
  const material::Voigt strain = voigt_strain(m.displacement_gradient);
  // (1) and (2) with E = -grad phi, (3).
  const material::Voigt stress = c.stiffness * strain +
                                 c.piezoelectric.transpose() * m.potential_gradient -
                                 c.thermal_stress * m.temperature;
  fields.strain.push_back(in_file_order(strain, 0.5));
  fields.stress.push_back(in_file_order(stress, 1));
  fields.von_mises.push_back(von_mises(fields.stress.back()));
  fields.electric_displacement.push_back(plain(c.piezoelectric * strain -
                                               c.permittivity * m.potential_gradient +
                                               c.pyroelectric * m.temperature));
  fields.heat_flux.push_back(plain(-c.conductivity * m.temperature_gradient));
}

}  // namespace

template <int dim>
output::CellFields derived_fields(const Discretisation<dim> &body,
                                  const material::Composition<dim> &composition,
                                  std::span<const double> state) {
  output::CellFields fields;
  const bool varies = composition.varies(), polar = composition.is_polar();
  body.for_each_cell([&](const Quadrature<dim> &cell) {
    const std::array<double, 3> centre = cell.centre();
    add_fields(means(cell, state), composition.in_space(cell.region, centre), fields);
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
