#include "contact/coulomb.h"

#include <cmath>

namespace tourmaline::contact {

double FrictionCoefficient::value(double slip) const {
  return kinetic + (at_rest - kinetic) * std::exp(-(before + per_slip * slip) / scale);
}

double FrictionCoefficient::derivative(double slip) const {
  return -(at_rest - kinetic) * std::exp(-(before + per_slip * slip) / scale) * per_slip / scale;
}

FrictionBound::Value Coulomb::at(double pressure, double slip) const {
  const double mu = coefficient_.value(slip), free = cohesion_ + mu * pressure;
  if (free <= 0)
    return {};
  if (free >= limit_)
    return {limit_, 0, 0};
  return {free, mu, coefficient_.derivative(slip) * pressure};
}

}  // namespace tourmaline::contact
