#pragma once

#include <Eigen/Dense>
#include <span>

#include "body/operator.h"
#include "material/constants.h"
#include "material/plane.h"
#include "output/records.h"

namespace tourmaline::body {

/// What (1)-(3) need at a place, in three dimensions.
struct Gradients {
  Eigen::Matrix3d displacement = Eigen::Matrix3d::Zero();
  Eigen::Vector3d potential = Eigen::Vector3d::Zero();
  Eigen::Vector3d temperature = Eigen::Vector3d::Zero();
  double theta = 0;
};

/// Adds `factor` times those at point q of a cell.
template <int dim>
void add_gradients(const Quadrature<dim> &cell, std::size_t q, std::span<const double> state,
                   double factor, Gradients &sum) {
  for (std::size_t a = 0; a < cell.nodes.size(); ++a) {
    const double *x = &state[unknown<dim>(cell.nodes[a], 0)];
    Eigen::Vector3d g = Eigen::Vector3d::Zero();
    for (int i = 0; i < dim; ++i)
      g[i] = factor * cell.gradient(q, a)[i];
    for (int c = 0; c < dim; ++c)
      sum.displacement.row(c) += x[c] * g.transpose();
    sum.potential += x[Fields<dim>::potential] * g;
    sum.temperature += x[Fields<dim>::temperature] * g;
    sum.displacement(2, 2) += factor * cell.around(q, a) * x[0];
    sum.theta += factor * cell.value(q, a) * x[Fields<dim>::temperature];
  }
}

/// In plane stress, the strains that nothing hinders across the plane.
void add_strains_across(material::Plane plane, const material::Constants &c, Gradients &at);
/// Engineering strains in Voigt's order.
material::Voigt strain_of(const Gradients &at);
/// (1) with E = -grad phi [Pa].
material::Voigt stress_of(const Gradients &at, const material::Constants &c);
/// From Voigt's order 11 22 33 23 13 12 to that of the files, xx yy zz xy yz xz.
output::SymmetricTensor in_file_order(const material::Voigt &v, double shear);

}  // namespace tourmaline::body
