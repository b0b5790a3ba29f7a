#pragma once

#include <concepts>
#include <optional>

#include "tourmaline/contact/friction.h"

namespace tourmaline::contact {

/// A friction law at one contact point in one step, as the free part z of the slip increment sees
/// it. The law acts on the whole increment (9): its components are d = (z, o), first the free ones,
/// then the part o that is known because something else moves the point along those directions.
/// (Movement that is known along free directions belongs into the state from which z is measured,
/// so o is orthogonal to them.) Then
///
///     j(z) = J(z, o),   J the law's dissipation,
///
/// is convex again. With o = 0 it has the kink of J; with o != 0 it is as smooth as J is there.
/// Everything is made of what every law offers. All tractions are lambda = -sigma_tau [N/m^2].
class PointLaw {
 public:
  PointLaw() = default;
  template <std::convertible_to<Friction> Law>
  PointLaw(Law law, Tangent held = {}) : law_(std::move(law)), held_(std::move(held)) {}

  const Friction &law() const { return law_; }
  const Tangent &held() const { return held_; }  ///< o [m]

  double dissipation(const Tangent &slip) const;  ///< j(z) [J/m^2]

  /// The free components of lambda for the trial value x = lambda + r z, r > 0 [N/m^3]: the only
  /// lambda in the subdifferential of j at (x - lambda) / r.
  Tangent traction(const Tangent &trial, double r) const;
  /// Its derivative in the trial value: symmetric, between 0 and the identity.
  TangentMatrix traction_derivative(const Tangent &trial, double r) const;
  /// slip where any component of d is not zero. A point without free components that is held at
  /// rest sticks.
  ContactStatus status(const Tangent &trial, double r) const;

  /// lambda in all components, from the slip z and its free components. Where the law leaves those
  /// along known directions open (the point is held at rest), they are of all that are possible the
  /// nearest to `borne`: what the contact would bear along them if nothing else held the point.
  Tangent whole_traction(const Tangent &slip, const Tangent &free, const Tangent &borne) const;

  /// Where j is differentiable; there follow its gradient [N/m^2] and Hessian [N/m^3].
  bool is_smooth_at(const Tangent &slip) const;
  Tangent gradient(const Tangent &slip) const;
  TangentMatrix hessian(const Tangent &slip) const;

  /// Whether j has a kink at z = 0; and whether it has in its place a bend as sharp as o is small.
  /// `n_free`: number of components of z.
  bool has_kink(Eigen::Index n_free) const;
  bool has_bend(Eigen::Index n_free) const;
  /// Radius of the ball of its tractions [N/m^2]; nothing where they are another set.
  std::optional<double> bound() const;

 private:
  Tangent whole(const Tangent &free, const Tangent &known) const;
  double known_trial(const Tangent &trial, double r, double start) const;
  Tangent whole_trial(const Tangent &trial, double r) const;
  Tangent known_traction(const Tangent &slip, const Tangent &free, const Tangent &borne) const;
  const FrictionLaw &rule() const { return law_of(law_); }

  Friction law_;
  Tangent held_ = Tangent(0);
};

}  // namespace tourmaline::contact
