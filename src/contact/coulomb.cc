#include "contact/coulomb.h"

#include <algorithm>
#include <cmath>

namespace tourmaline::contact {

double FrictionCoefficient::value(double slip) const {
  return kinetic + (at_rest - kinetic) * std::exp(-(before + per_slip * slip) / scale);
}

double FrictionCoefficient::derivative(double slip) const {
  return -(at_rest - kinetic) * std::exp(-(before + per_slip * slip) / scale) * per_slip / scale;
}

FrictionBound::Value Coulomb::at(double pressure, double slip) const {
  const double p = std::max(0., pressure), mu = coefficient_.value(slip);
  const double free = cohesion_ + mu * p;
  if (free >= limit_)
    return {limit_, 0, 0};
  return {free, pressure > 0 ? mu : 0, coefficient_.derivative(slip) * p};
}

}  // namespace tourmaline::contact
