#include "contact/heat_exchange.h"

#include <cmath>

namespace tourmaline::contact {

double PressureConductance::value(double pressure) const {
  return pressure > 0 && coefficient > 0 ? coefficient * std::pow(pressure / reference, exponent)
                                         : 0;
}

double PressureConductance::derivative(double pressure) const {
  return pressure > 0 ? exponent * value(pressure) / pressure : 0;
}

Exchange::Value HeatExchange::at(double theta, const ContactState &state) const {
  const double warmer = theta - is_.foundation;
  const double conductance =
      is_.faded * is_.ramp.value(state.penetration) + is_.by_pressure.value(state.pressure);
  Value value;
  value.flow = conductance * warmer - is_.friction_share * state.friction;
  value.by_value = conductance;
  value.by_pressure = is_.by_pressure.derivative(state.pressure) * warmer;
  value.by_penetration = is_.faded * is_.ramp.derivative(state.penetration) * warmer;
  value.by_friction = -is_.friction_share;
  return value;
}

}  // namespace tourmaline::contact
