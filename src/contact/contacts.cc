#include "contact/contacts.h"

#include <algorithm>

namespace tourmaline::contact {

Contacts::Contacts(const std::vector<casefile::ContactCase> &asked, double step) {
  for (const casefile::ContactCase &contact : asked)
    all_.emplace_back(contact, step);
}

std::vector<body::SurfaceExchange> Contacts::linear_exchanges() const {
  std::vector<body::SurfaceExchange> exchanges;
  for (const ContactLaws &laws : all_)
    for (const Crossing what : {Crossing::heat, Crossing::charge})
      if (const auto linear = laws.linear(what))
        exchanges.push_back(*linear);
  return exchanges;
}

bool Contacts::any(bool (ContactLaws::*is_so)() const) const {
  return std::any_of(all_.begin(), all_.end(),
                     [&](const ContactLaws &laws) { return (laws.*is_so)(); });
}

bool Contacts::has_moving_foundation() const {
  return any(&ContactLaws::has_moving_foundation);
}

bool Contacts::has_normal_unknowns() const {
  return any(&ContactLaws::has_normal_unknowns);
}

bool Contacts::can_open() const {
  return any(&ContactLaws::can_open);
}

bool Contacts::friction_depends_on_pressure() const {
  return any(&ContactLaws::friction_depends_on_pressure);
}

bool Contacts::remembers_slip() const {
  return any(&ContactLaws::remembers_slip);
}

bool Contacts::is_warmed_by_friction() const {
  return any(&ContactLaws::is_warmed_by_friction);
}

bool Contacts::remembers_charge() const {
  return any(&ContactLaws::remembers_charge);
}

bool Contacts::crosses_by_state(Crossing what) const {
  return std::any_of(all_.begin(), all_.end(),
                     [&](const ContactLaws &laws) { return laws.crosses_by_state(what); });
}

FrictionAt Contacts::friction() const {
  std::vector<FrictionAt> by_contact;
  for (const ContactLaws &laws : all_)
    by_contact.push_back(laws.friction());
  return [by_contact](const ContactPlace &place) { return by_contact[place.contact](place); };
}

void Contacts::set_step(double step) {
  for (ContactLaws &laws : all_)
    laws.set_step(step);
}

void Contacts::replace_friction() {
  for (ContactLaws &laws : all_)
    laws.replace_friction();
}

}  // namespace tourmaline::contact
