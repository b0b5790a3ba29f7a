#include "contact/laws.h"

#include "contact/kinds.h"

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
  return can_open() || has_bound();
}

bool ContactLaws::friction_depends_on_pressure() const {
  return has_bound() || (can_open() && (is_replaced_ || asked_.friction.resists()));
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

FrictionAt ContactLaws::friction() const {
  return friction_of(asked_.friction);
}

std::shared_ptr<const FrictionBound> ContactLaws::bound(const Vector3 &point, double time,
                                                        double slipped) const {
  return has_bound() ? kind_of(asked_.friction).bound(asked_.friction, point, time, step_, slipped)
                     : nullptr;
}

}  // namespace tourmaline::contact
