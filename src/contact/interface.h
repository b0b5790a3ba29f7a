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
  std::size_t contact = 0;  ///< whose laws hold at the node: by the order of the case file
};

/// The nodes of the named boundaries, those of one contact, in ascending order. Throws CaseError
/// where a weight is not positive (quadratic tetrahedra), because complementarity node by node
/// needs positive weights, and where the facets of a node have no common normal (contact around a
/// corner).
template <int dim>
std::vector<InterfaceNode<dim>> interface_nodes(const body::Discretisation<dim> &body,
                                                const std::vector<std::string> &boundaries);

/// Of several contacts, each by the names of its boundaries. A node where contacts meet belongs to
/// the first of them. Further ones that meet it there smoothly, so that one normal serves as in a
/// single contact, add their facets to its weight and normal. Of one that meets it at an edge the
/// node's share is left out, as it would take a second normal.
template <int dim>
struct Interface {
  std::vector<InterfaceNode<dim>> nodes;  ///< in ascending order
  std::vector<body::Node> edges;          ///< those of which a contact's share is left out
};
template <int dim>
Interface<dim> interface_of(const body::Discretisation<dim> &body,
                            const std::vector<std::vector<std::string>> &contacts);

}  // namespace tourmaline::contact
