#pragma once

#include "tourmaline/contact/friction_law.h"

namespace tourmaline::contact {

/// Tresca's law of dry friction (9): |sigma_tau| <= S, and sigma_tau = -S du / |du| where the point
/// slips.
///
/// With lambda = -sigma_tau and the slip increment d over the step it reads, for any r > 0 (35),
///
///     lambda = P(lambda + r d),   P the projection onto the ball of radius S,
///
/// or lambda in the subdifferential of the dissipation S |d|.
class Tresca final : public FrictionLaw {
 public:
  explicit Tresca(double bound_of_it = 0) : bound(bound_of_it) {}

  double bound;  ///< S >= 0, finite [N/m^2]

  double dissipation(const Tangent &d) const override;
  Tangent traction(const Tangent &trial) const override;
  /// The identity inside the ball and on it (a point at the bound without slip sticks), outside S /
  /// |x| (I - x x^T / |x|^2).
  TangentMatrix traction_derivative(const Tangent &trial) const override;
  ContactStatus status(const Tangent &trial) const override;

  /// Everywhere but at d = 0, and there if S = 0.
  bool is_smooth_at(const Tangent &d) const override;
  Tangent gradient(const Tangent &d) const override;
  TangentMatrix hessian(const Tangent &d) const override;
};

}  // namespace tourmaline::contact
