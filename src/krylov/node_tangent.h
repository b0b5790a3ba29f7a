#pragma once

#include <Eigen/Dense>

#include "body/discretisation.h"

namespace tourmaline::krylov {

/// What the contact leaves a node: displacements in the range of `projector` (symmetric, its square
/// itself), and a stiffness [N/m] against them; and what crosses there with phi and theta.
template <int dim>
struct NodeTangent {
  using Matrix = Eigen::Matrix<double, dim, dim>;

  body::Node node;
  Matrix projector, stiffness;
  Eigen::Vector2d crossing =
      Eigen::Vector2d::Zero();  ///< what K_phi,phi and K_theta,theta are less by

  bool operator==(const NodeTangent &) const = default;
};

/// What else acts at a contact node, along directions that its projector leaves free: `of_force`
/// times the node's rows of K x, and `of_displacement` [N/m] times its displacement.
template <int dim>
struct NodeCoupling {
  typename NodeTangent<dim>::Matrix of_force, of_displacement;
};

}  // namespace tourmaline::krylov
