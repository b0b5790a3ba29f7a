#pragma once

#include "contact/normal_law.h"

namespace tourmaline::contact {

/// Bilateral contact (9), delta = 0, where a law needs its pressure, which may be of either sign.
class HeldNormal : public NormalLaw {
 public:
  double pressure(double trial, double r) const override;
  double pressure_derivative(double trial, double r) const override;
  bool is_smooth_at(double delta) const override;
  double pressure_at(double delta) const override;
  double stiffness_at(double delta) const override;
  bool has_kink() const override { return true; }
  double potential(double delta) const override;
  bool is_closed(double trial) const override;
};

}  // namespace tourmaline::contact
