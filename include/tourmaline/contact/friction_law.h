#pragma once

#include <memory>

#include "tourmaline/contact/tangent.h"
#include "tourmaline/contact_status.h"

namespace tourmaline::contact {

/// A friction law that a program of somebody else brings along (examples/). With lambda =
/// -sigma_tau and the slip increment d over a step it says, for any r > 0,
///
///     lambda = P(lambda + r d),   P the projection onto a closed convex set C that holds 0,
///
/// or lambda in the subdifferential of the dissipation j(d) = sup over lambda in C of lambda.d,
/// which is convex and positively homogeneous: j(a d) = a j(d), a > 0. A law whose dissipation is
/// not, like friction that grows with the slip rate or is regularised, is none of this kind.
/// Vectors have as many components as the argument: one in two dimensions, two in three. d is the
/// whole tangential slip, also where other conditions move the point. `Tresca`, whose C is a ball,
/// is one of them.
///
/// What decides the numbers: `traction`, as a step is done when lambda = P(lambda + r d) holds at
/// all points; `status`, which must be that of `traction`; and at points that prescribed components
/// move along the foundation `gradient`, their friction. The others decide how fast that is found,
/// or that it is not (SolveError).
///
/// A run looks at every answer: other numbers of components, numbers that are not finite, a status
/// against `traction`, a gradient against `dissipation`, and exceptions that are no
/// `tourmaline::Error` end it with a CaseError that names law and place. On several ranks the
/// condensed route asks on the first rank only, the others on every rank; there all must answer the
/// same.
class FrictionLaw {
 public:
  virtual ~FrictionLaw() = default;

  virtual double dissipation(const Tangent &d) const = 0;                     ///< j(d) [J/m^2]
  virtual Tangent traction(const Tangent &trial) const = 0;                   ///< P [N/m^2]
  virtual TangentMatrix traction_derivative(const Tangent &trial) const = 0;  ///< P'
  /// stick where P leaves the trial value as it is (on the border of C either), slip elsewhere.
  virtual ContactStatus status(const Tangent &trial) const {
    return traction(trial) == trial ? ContactStatus::stick : ContactStatus::slip;
  }

  /// Where j is differentiable; there follow its gradient [N/m^2] and Hessian [N/m^3].
  virtual bool is_smooth_at(const Tangent &d) const = 0;
  virtual Tangent gradient(const Tangent &d) const = 0;
  virtual TangentMatrix hessian(const Tangent &d) const = 0;
};

/// Such a law as a value beside the others; one there must be.
struct OwnLaw {
  std::shared_ptr<const FrictionLaw> law;
};

}  // namespace tourmaline::contact
