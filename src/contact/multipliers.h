#pragma once

#include <Eigen/Dense>
#include <string>
#include <vector>

#include "contact/augmented_lagrangian.h"
#include "contact/interface.h"
#include "tourmaline/vector.h"

namespace tourmaline::contact {

/// A place that carries a multiplier: a contact node, or a facet of Gamma_C. The displacement that
/// the contact law sees there is the sum of `factor` * u(`node`) over `mean`: the nodal value, or
/// the mean over the facet.
template <int dim>
struct MultiplierPoint {
  struct Share {
    body::Node node;
    double factor;
  };
  using Vector = Eigen::Matrix<double, dim, 1>;
  using Directions = Eigen::Matrix<double, dim, Eigen::Dynamic, 0, dim, dim>;

  Vector3 place{};          ///< where the friction bound is taken
  std::size_t contact = 0;  ///< as of `InterfaceNode`
  double weight = 0;        ///< w, area that the traction acts on [m^(dim-1)]
  std::vector<Share> mean;
  bool has_normal = false;  ///< whether u_nu = 0 is a condition here, the first of the directions
  Directions directions;    ///< columns: normal, then orthonormal tangential ones
  /// Orthonormal columns that complete these in the tangent plane: the slip along them is known. It
  /// follows from prescribed components alone, by the columns of `held_now`: held^T u = held_now^T
  /// u where u_nu = 0.
  Directions held, held_now;

  Eigen::Index n_multipliers() const { return directions.cols(); }

  /// (u_nu, d) from the values of all unknowns now and at the last step, u_nu measured from `rest`,
  /// in which the contact nodes touch the foundation.
  Local displacement(std::span<const double> state, std::span<const double> before,
                     std::span<const double> rest) const;

  /// The known slip (`Admissible::held_slip`) when `state` holds the prescribed values.
  Tangent held_slip(std::span<const double> state, std::span<const double> before,
                    std::span<const double> rest) const;
  /// Directions of the tangential multipliers, then `held`: those of a law's components.
  Directions tangent() const;

 private:
  Vector mean_of(std::span<const double> values) const;
};

/// Which unknowns of the body are prescribed; multipliers stand only in directions that are free.
using IsPrescribed = std::vector<bool>;

/// One multiplier a contact node, with the lumped quadrature: (34), (35) hold node by node, with
/// the admissible directions of `bilateral`. The normal is divided by the size of its part in the
/// free components, so that displacement()[0] = 0 fixes those as `bilateral` does.
template <int dim>
std::vector<MultiplierPoint<dim>> nodal_multipliers(
    const std::vector<InterfaceNode<dim>> &interface, const IsPrescribed &is_prescribed);

/// One multiplier a facet: the piecewise constants Y^h of section 3.1. A direction that is
/// prescribed at all nodes of a facet has none there. Throws CaseError when the multipliers are not
/// independent as functionals on the free displacements: then they are not determined.
template <int dim>
std::vector<MultiplierPoint<dim>> facet_multipliers(const body::Discretisation<dim> &body,
                                                    const std::vector<std::string> &boundaries,
                                                    const IsPrescribed &is_prescribed);

}  // namespace tourmaline::contact
