#pragma once

#include <cmath>
#include <memory>
#include <utility>

#include "contact/normal_law.h"

namespace tourmaline::contact {

/// Yosida's approximation of a normal law: the law behind a spring of stiffness c > 0 [N/m^3]. Its
/// pressure at delta is the law's resolvent of c delta with r = c, its potential Moreau's envelope.
class YosidaNormal : public NormalLaw {
 public:
  YosidaNormal(std::shared_ptr<const NormalLaw> law, double c) : law_(std::move(law)), c_(c) {}

  double pressure(double trial, double r) const override {
    return law_->pressure(share(r) * trial, share(r) * r);
  }
  double pressure_derivative(double trial, double r) const override {
    return share(r) * law_->pressure_derivative(share(r) * trial, share(r) * r);
  }
  bool is_smooth_at(double /*delta*/) const override { return true; }
  double pressure_at(double delta) const override { return law_->pressure(c_ * delta, c_); }
  double stiffness_at(double delta) const override {
    return c_ * law_->pressure_derivative(c_ * delta, c_);
  }
  bool has_kink() const override { return false; }
  double potential(double delta) const override {
    constexpr double round_off = 1e-15;
    const double p = pressure_at(delta), own = delta - p / c_;
    const double of_law = law_->potential(std::abs(own) <= round_off * std::abs(delta) ? 0 : own);
    return of_law + p * p / (2 * c_);
  }
  bool is_closed(double trial) const override { return law_->is_closed(trial); }

 private:
  double share(double r) const { return c_ / (c_ + r); }

  std::shared_ptr<const NormalLaw> law_;
  double c_;
};

}  // namespace tourmaline::contact
