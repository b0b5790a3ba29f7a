#pragma once

#include "body/fields.h"
#include "material/plane.h"

namespace tourmaline::body {

/// The storage operator between two nodes.
template <int dim>
using NodeBlock = Eigen::Matrix<double, Fields<dim>::count, Fields<dim>::count, Eigen::RowMajor>;

template <int dim>
using Strains = Eigen::Matrix<double, material::n_strains<dim>, dim>;

// Strain (engineering shear) of a displacement with shape gradient g, by component: eps(u) = B u;
// `around` is `Quadrature::around`.
inline Strains<2> strain_of(const std::array<double, 2> &g, double around) {
  Strains<2> b;
  b << g[0], 0, 0, g[1], around, 0, g[1], g[0];
  return b;
}

inline Strains<3> strain_of(const std::array<double, 3> &g, double) {
  Strains<3> b;
  b << g[0], 0, 0, 0, g[1], 0, 0, 0, g[2], 0, g[2], g[1], g[2], 0, g[0], g[1], g[0], 0;
  return b;
}

// What one shape function does at one point: the fields' derivatives, multiplied by the constants.
template <int dim>
struct Trial {
  Eigen::Matrix<double, dim, 1> gradient;
  Strains<dim> strain;
  Strains<dim> stress;                     // F B
  Eigen::Matrix<double, dim, dim> charge;  // E B
  Eigen::Matrix<double, dim, 1> electric;  // beta g
  Eigen::Matrix<double, 1, dim> heat;      // M^T B
  double pyroelectric;                     // P . g
};

template <int dim>
Trial<dim> trial(const material::BodyConstants<dim> &c,
                 const std::array<double, static_cast<std::size_t>(dim)> &gradient, double around) {
  Trial<dim> t;
  t.gradient = Eigen::Map<const Eigen::Matrix<double, dim, 1>>(gradient.data());
  t.strain = strain_of(gradient, around);
  t.stress = c.stiffness * t.strain;
  t.charge = c.piezoelectric * t.strain;
  t.electric = c.permittivity * t.gradient;
  t.heat = c.thermal_stress.transpose() * t.strain;
  t.pyroelectric = c.pyroelectric.dot(t.gradient);
  return t;
}

// Integrals of 1 and of the values of a test function a and a trial function b.
struct Weights {
  double one, a, b, ab;
};

// The storage operator's block between test function a and trial function b, where their gradients
// do not change.
template <int dim>
void add_block(const Trial<dim> &a, const Trial<dim> &b, double heat_capacity, const Weights &w,
               NodeBlock<dim> &block) {
  constexpr int phi = Fields<dim>::potential, theta = Fields<dim>::temperature;
  block.template topLeftCorner<dim, dim>() += w.one * a.strain.transpose() * b.stress;
  block.template block<dim, 1>(0, phi) += w.one * a.charge.transpose() * b.gradient;
  block.template block<1, dim>(phi, 0) += w.one * a.gradient.transpose() * b.charge;
  block.template block<dim, 1>(0, theta) -= w.b * a.heat.transpose();
  block.template block<1, dim>(theta, 0) -= w.a * b.heat;
  block(phi, phi) -= w.one * a.gradient.dot(b.electric);
  block(phi, theta) += w.b * a.pyroelectric;
  block(theta, phi) += w.a * b.pyroelectric;
  block(theta, theta) -= w.ab * heat_capacity;
}

}  // namespace tourmaline::body
