#pragma once

#include <Eigen/Dense>
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "contact/interface.h"
#include "tourmaline/contact/tangent.h"

namespace tourmaline::contact {

/// Bilateral contact (9), u_nu = `reach` (0 in the paper), at one node of which some components may
/// be prescribed as well: the admissible displacements are u = base + directions z with free z.
/// What is tangential splits into the free part and a part that is known, because prescribed
/// components move it, alone or with u_nu = 0 (a tilted foundation). The slip that friction (9)
/// sees is both.
template <int dim>
struct Admissible {
  using Vector = Eigen::Matrix<double, dim, 1>;
  using Directions = Eigen::Matrix<double, dim, Eigen::Dynamic, 0, dim, dim>;
  using Prescribed = std::array<std::optional<double>, dim>;  // by component, its value [m]

  Vector base;  ///< [m]
  /// orthonormal columns, tangential and orthogonal to the prescribed components
  Directions directions;
  /// orthonormal columns that complete `directions` to a basis of the tangent plane: along them the
  /// displacement is that of `base`
  Directions held;
  Vector normal;
  /// the part of the normal in free components; zero where that is no more than round-off
  Vector free_normal;
  std::array<bool, dim> is_prescribed;

  /// With other values of the same prescribed components, and another reach [m].
  void set_base(const Prescribed &prescribed, double reach);

  /// `directions`, then `held`: the columns that a law's components belong to (`PointLaw`).
  Directions tangent() const;

  /// Slip along `held` [m] over a step from the displacement `before`; exactly zero where it is no
  /// more than the round-off of the two displacements.
  Tangent held_slip(const Vector &before) const;

  /// Of the nodal force [N] that holds the node in its place, with `friction` [N] in it, the part
  /// that the support of the prescribed components bears: 0 in free components. What is left is
  /// friction and a force along the normal. Where the normal lies in the span of prescribed
  /// components nothing tells foundation and support apart, and all along it is the foundation's.
  Vector support(const Vector &force, const Vector &friction) const;
};

/// `prescribed[c]` [m] where component c is prescribed. Where the normal lies in the span of
/// prescribed components the prescribed values hold, not u_nu = reach.
template <int dim>
Admissible<dim> bilateral(const Eigen::Matrix<double, dim, 1> &normal,
                          const std::array<std::optional<double>, dim> &prescribed,
                          double reach = 0);

/// Throws CaseError where some components of a node are prescribed and its normal is oblique to
/// them: what happens along the normal would then be a part of the slip. Where that counts.
template <int dim>
void require_plain_normal(const InterfaceNode<dim> &at, const Admissible<dim> &admissible);

/// What is prescribed at a contact node of a body with the unknowns `state`.
template <int dim>
typename Admissible<dim>::Prescribed prescribed_at(const InterfaceNode<dim> &at,
                                                   const std::vector<bool> &is_prescribed,
                                                   std::span<const double> state);

/// Bilateral contact at a contact node of a body with the unknowns `state`.
template <int dim>
Admissible<dim> bilateral(const InterfaceNode<dim> &at, const std::vector<bool> &is_prescribed,
                          std::span<const double> state, double reach = 0);

}  // namespace tourmaline::contact
