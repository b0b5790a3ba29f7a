#include "contact/laws.h"

#include "contact/charge_exchange.h"
#include "contact/heat_exchange.h"
#include "contact/kinds.h"
#include "contact/values.h"

namespace tourmaline::contact {

ContactLaws::ContactLaws(const casefile::ContactCase &asked, double step)
    : asked_(asked), step_(step) {}

double ContactLaws::gap(const Vector3 &point) const {
  return asked_.gap.value(point, 0);
}

Vector3 ContactLaws::foundation(const Vector3 &point, double time) const {
  Vector3 moved{};
  for (std::size_t c = 0; c < asked_.foundation_displacement.size(); ++c)
    moved[c] = asked_.foundation_displacement[c].value(point, time);
  return moved;
}

bool ContactLaws::has_bound() const {
  return !is_replaced_ && kind_of(asked_.friction).bound != nullptr;
}

bool ContactLaws::can_open() const {
  return asked_.normal.can_open();
}

bool ContactLaws::has_normal_unknowns() const {
  return can_open() || has_bound() || asked_.heat.pressure;
}

bool ContactLaws::friction_depends_on_pressure() const {
  return has_bound() || (can_open() && resists());
}

void ContactLaws::replace_friction() {
  is_replaced_ = true;
}

bool ContactLaws::remembers_slip() const {
  return has_bound() && asked_.friction.coefficient.distance.has_value();
}

std::shared_ptr<const NormalLaw> ContactLaws::normal(const Vector3 &point, double before) const {
  return kind_of(asked_.normal).at(asked_.normal, point, step_, before);
}

double ContactLaws::pressure_under_supports(const Vector3 &point, double before, double now) const {
  const auto law = normal(point, before);
  return law->is_smooth_at(now) ? law->pressure_at(now) : 0;
}

bool ContactLaws::is_closed_under_supports(const Vector3 &point, double before, double now) const {
  const auto law = normal(point, before);
  constexpr double r = 1;  // [N/m^3], any
  return law->is_smooth_at(now) && law->is_closed(law->pressure_at(now) + r * now);
}

FrictionAt ContactLaws::friction() const {
  return friction_of(asked_.friction);
}

std::shared_ptr<const FrictionBound> ContactLaws::bound(const Vector3 &point, double time,
                                                        double slipped) const {
  return has_bound() ? kind_of(asked_.friction).bound(asked_.friction, point, time, step_, slipped)
                     : nullptr;
}

bool ContactLaws::is_warmed_by_friction() const {
  return resists() && asked_.heat.friction_share.value_or(0) > 0;
}

bool ContactLaws::remembers_charge() const {
  return asked_.electric.law == "leak";
}

bool ContactLaws::lets_pass(Crossing what) const {
  return what == Crossing::heat ? asked_.heat.exchanges() || is_warmed_by_friction()
                                : asked_.electric.exchanges();
}

bool ContactLaws::crosses_by_state(Crossing what) const {
  if (what == Crossing::heat)
    return asked_.heat.pressure || asked_.heat.ramp || is_warmed_by_friction();
  return asked_.electric.ramp.has_value();
}

std::optional<body::SurfaceExchange> ContactLaws::linear(Crossing what) const {
  const casefile::HeatExchangeCase &heat = asked_.heat;
  const casefile::ChargeExchangeCase &electric = asked_.electric;
  if (what == Crossing::heat && heat.exchanges() && !heat.ramp)
    return {{body::SurfaceExchange::temperature, asked_.on, heat.coefficient,
             heat.foundation_temperature}};
  if (what == Crossing::charge && electric.exchanges() && !crosses_by_state(what))
    return {{body::SurfaceExchange::potential, asked_.on, electric.coefficient,
             electric.foundation_potential.value_or(0.), remembers_charge() ? step_ : 1.,
             remembers_charge()}};
  return std::nullopt;
}

std::shared_ptr<const Exchange> ContactLaws::exchange(Crossing what, const Vector3 &point,
                                                      double time, double before) const {
  if (!crosses_by_state(what))
    return nullptr;
  return what == Crossing::heat ? heat_exchange(point, time) : charge_exchange(point, time, before);
}

// k_c is here where it fades with the gap; elsewhere it is the operator's.
std::shared_ptr<const Exchange> ContactLaws::heat_exchange(const Vector3 &point,
                                                           double time) const {
  const casefile::HeatExchangeCase &asked = asked_.heat;
  HeatExchange::Parameters is;
  is.ramp = Ramp(asked.ramp);
  is.foundation = asked.foundation_temperature.value(point, time);
  if (asked.ramp)
    is.faded = not_negative(asked.coefficient, point, 0, "the coefficient of heat exchange");
  if (const auto &pressure = asked.pressure)
    is.by_pressure = {not_negative(pressure->coefficient, point, 0,
                                   "the coefficient of heat exchange by the pressure"),
                      pressure->reference, pressure->exponent};
  if (is_warmed_by_friction())
    is.friction_share = *asked.friction_share / step_;
  return std::make_shared<HeatExchange>(is);
}

std::shared_ptr<const Exchange> ContactLaws::charge_exchange(const Vector3 &point, double time,
                                                             double before) const {
  const casefile::ChargeExchangeCase &asked = asked_.electric;
  ChargeExchange::Parameters is;
  is.coefficient = not_negative(asked.coefficient, point, 0, "the coefficient of charge exchange");
  is.ramp = Ramp(asked.ramp);
  is.foundation = asked.foundation_potential.value_or(0.).value(point, time);
  if (remembers_charge()) {
    is.coefficient *= step_;
    is.before = before;
  }
  return std::make_shared<ChargeExchange>(is);
}

}  // namespace tourmaline::contact
