#include "contact/held_normal.h"

#include <limits>

namespace tourmaline::contact {

double HeldNormal::pressure(double trial, double /*r*/) const {
  return trial;
}

double HeldNormal::pressure_derivative(double /*trial*/, double /*r*/) const {
  return 1;
}

bool HeldNormal::is_smooth_at(double /*delta*/) const {
  return false;
}

double HeldNormal::pressure_at(double /*delta*/) const {
  return 0;
}

double HeldNormal::stiffness_at(double /*delta*/) const {
  return 0;
}

double HeldNormal::potential(double delta) const {
  return delta == 0 ? 0 : std::numeric_limits<double>::infinity();
}

bool HeldNormal::is_closed(double /*trial*/) const {
  return true;
}

}  // namespace tourmaline::contact
