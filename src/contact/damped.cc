#include "contact/damped.h"

namespace tourmaline::contact {

double Damped::pressure(double trial, double r) const {
  return layer_.pressure(trial - r * before_, r);
}

double Damped::pressure_derivative(double trial, double r) const {
  return layer_.pressure_derivative(trial - r * before_, r);
}

double Damped::pressure_at(double delta) const {
  return layer_.pressure_at(delta - before_);
}

double Damped::stiffness_at(double delta) const {
  return layer_.stiffness_at(delta - before_);
}

double Damped::potential(double delta) const {
  return layer_.potential(delta - before_);
}

double Damped::dissipated(double delta) const {
  return pressure_at(delta) * (delta - before_);
}

}  // namespace tourmaline::contact
