#pragma once

#include <Eigen/Dense>
#include <vector>

#include "krylov/body_system.h"
#include "solve/contact_body.h"
#include "solve/contact_nodes.h"

namespace tourmaline::solve {

/// A `ContactTangent` as conditions at the contact nodes of the body. What of its points is free
/// has, with the rows divided by I - D, the equations
///
///     A x + H x + (coupling) = force.
///
/// Directions in which a law is nearly vertical (D near to I) are as good as held: across a slip
/// that is almost nothing friction is too stiff for a preconditioner. There x is what the law alone
/// says.
template <int dim>
struct NodeSystem {
  NodeSystem(const ContactNodes<dim> &contact, const Model<dim> &model,
             const ContactTangent &tangent);

  bool is_coupled() const { return is_coupled_; }

  std::vector<krylov::NodeTangent<dim>> tangents;
  std::vector<krylov::NodeCoupling<dim>> couplings;
  Eigen::VectorXd known;     ///< x of what is held [m]
  Eigen::VectorXd force;     ///< [N]
  Eigen::MatrixXd of_share;  ///< what one unit of each share of the tangent adds to it

 private:
  using Directions = Eigen::Matrix<double, dim, Eigen::Dynamic, 0, dim, dim>;
  using Matrix = Eigen::Matrix<double, dim, dim>;

  void add(const ContactTangent::Point &at, const ContactTangent &tangent);
  Directions directions(std::size_t point) const;

  const ContactNodes<dim> &contact_;
  bool is_coupled_ = false;
};

}  // namespace tourmaline::solve
