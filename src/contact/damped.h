#pragma once

#include "contact/compliance.h"

namespace tourmaline::contact {

/// Damped response: p = c d(delta+)/dt where the penetration delta+ = max(delta, 0) grows, else 0.
/// The foundation yields and gives nothing back: a lubricated or granular layer. With backward
/// differences p = (c/k) (delta - max(delta_before, 0))+. (M. Shillor, M. Sofonea, J. J. Telega,
/// Models and Analysis of Quasistatic Contact, Springer 2004, section 2.6.)
class Damped : public NormalLaw {
 public:
  /// c > 0 [N s/m^3], k > 0 the time step [s], the penetration of the step before [m].
  Damped(double coefficient, double step, double before)
      : layer_(coefficient / step, 1), before_(before > 0 ? before : 0) {}

  double pressure(double trial, double r) const override;
  double pressure_derivative(double trial, double r) const override;
  bool is_smooth_at(double /*delta*/) const override { return true; }
  double pressure_at(double delta) const override;
  double stiffness_at(double delta) const override;
  bool has_kink() const override { return false; }
  double potential(double delta) const override;
  double dissipated(double delta) const override;

 private:
  Compliance layer_;  // in what delta exceeds `before_`
  double before_;
};

}  // namespace tourmaline::contact
