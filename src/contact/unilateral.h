#pragma once

#include "contact/normal_law.h"

namespace tourmaline::contact {

/// Signorini's conditions: delta <= 0, p >= 0, p delta = 0. The body leaves the foundation freely
/// and does not enter it.
class Unilateral : public NormalLaw {
 public:
  double pressure(double trial, double r) const override;
  double pressure_derivative(double trial, double r) const override;
  bool is_smooth_at(double delta) const override;
  double pressure_at(double delta) const override;
  double stiffness_at(double delta) const override;
  bool has_kink() const override { return true; }
  double potential(double delta) const override;
};

}  // namespace tourmaline::contact
