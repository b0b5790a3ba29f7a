#include "contact/charge_exchange.h"

namespace tourmaline::contact {

Exchange::Value ChargeExchange::at(double phi, const ContactState &state) const {
  const double higher = phi - is_.foundation;
  Value value;
  value.by_value = is_.coefficient * is_.ramp.value(state.penetration);
  value.flow = is_.before + value.by_value * higher;
  value.by_penetration = is_.coefficient * is_.ramp.derivative(state.penetration) * higher;
  return value;
}

}  // namespace tourmaline::contact
