#pragma once

#include "contact/normal_law.h"

namespace tourmaline::contact {

/// Normal compliance: p = c delta^m where delta > 0, of a layer of asperities that is pressed
/// together and gives back all work. (J. A. C. Martins, J. T. Oden, Nonlinear Analysis 11 (1987)
/// 407-428.)
class Compliance : public NormalLaw {
 public:
  /// c > 0 [N/m^(2+m)], m >= 1.
  Compliance(double coefficient, double exponent)
      : coefficient_(coefficient), exponent_(exponent) {}

  double pressure(double trial, double r) const override;
  double pressure_derivative(double trial, double r) const override;
  bool is_smooth_at(double /*delta*/) const override { return true; }
  double pressure_at(double delta) const override;
  double stiffness_at(double delta) const override;
  bool has_kink() const override { return false; }
  double potential(double delta) const override;
  double stored(double delta) const override { return potential(delta); }

 private:
  double penetration(double trial, double r) const;

  double coefficient_, exponent_;
};

}  // namespace tourmaline::contact
