#pragma once

#include "tourmaline/contact/tangent.h"
#include "tourmaline/contact_status.h"

namespace tourmaline::contact {

/// Tresca's law of dry friction (9): |sigma_tau| <= S, and sigma_tau = -S du / |du| where the point
/// slips.
///
/// With lambda = -sigma_tau and the slip increment d over the step it reads, for any r > 0 (35),
///
///     lambda = P(lambda + r d),   P the projection onto the ball of radius S,
///
/// or lambda in the subdifferential of the dissipation S |d|.
struct Tresca {
  double bound = 0;  ///< S >= 0, finite [N/m^2]

  /// Dissipation per area over an increment d [m]: S |d| [J/m^2].
  double dissipation(const Tangent &d) const;
  /// lambda for the trial value lambda + r d [N/m^2].
  Tangent traction(const Tangent &trial) const;
  /// Derivative of `traction`: the identity inside the ball and on it (a point at the bound without
  /// slip sticks), outside S / |x| (I - x x^T / |x|^2).
  TangentMatrix traction_derivative(const Tangent &trial) const;
  /// slip where the trial value lies outside the ball.
  ContactStatus status(const Tangent &trial) const;

  /// Where the dissipation is smooth: d != 0, or S = 0. There follow its gradient [N/m^2] and
  /// Hessian [N/m^3].
  bool is_smooth_at(const Tangent &d) const;
  Tangent gradient(const Tangent &d) const;
  TangentMatrix hessian(const Tangent &d) const;
};

}  // namespace tourmaline::contact
