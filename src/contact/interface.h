#pragma once

#include <Eigen/Dense>
#include <string>
#include <vector>

#include "body/discretisation.h"
#include "tourmaline/vector.h"

namespace tourmaline::contact {

/// A node of Gamma_C with its lumped weight, the integral of its shape function over Gamma_C
/// [m^(dim-1)], and the outward normal nu, the mean of the facets' normals with the same weights.
template <int dim>
struct InterfaceNode {
  body::Node node;
  Vector3 point;
  double weight;
  Eigen::Matrix<double, dim, 1> normal;
};

/// The nodes of the named boundaries in ascending order. Throws CaseError where a weight is not
/// positive (quadratic tetrahedra), because complementarity node by node needs positive weights,
/// and where the facets of a node have no common normal (contact around a corner).
template <int dim>
std::vector<InterfaceNode<dim>> interface_nodes(const body::Discretisation<dim> &body,
                                                const std::vector<std::string> &boundaries);

}  // namespace tourmaline::contact
