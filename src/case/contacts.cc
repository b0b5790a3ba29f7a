#include "case/contacts.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "case/place_of_key.h"
#include "case/toml_text.h"
#include "tourmaline/case/case.h"
#include "tourmaline/error.h"

namespace tourmaline::casefile {

std::string ContactCase::crosses_by_state() const {
  if (heat.pressure)
    return "heat.pressure";
  if (heat.ramp)
    return "heat.ramp";
  if (heat.friction_share.value_or(0) > 0)
    return "heat.friction_share";
  return electric.ramp ? "electric.ramp" : "";
}

std::string ContactCase::called() const {
  return name ? *name : fmt::format("{}", fmt::join(on, "+"));
}

namespace {

[[noreturn]] void fail(const ContactCase &contact, const std::string &reason) {
  const std::string key = contact.name ? "name" : "on";
  throw CaseError(fmt::format("{} = {}: {}", place_of_key(contact.places, contact.where, key),
                              toml_text(contact.called()), reason));
}

bool is_plain(const std::string &name) {
  return !name.empty() && std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-';
  });
}

}  // namespace

void check_contacts(const Case &asked) {
  std::map<std::string, std::string> first;  // where the name was said first
  for (const ContactCase &contact : asked.contacts) {
    if (contact.name && !is_plain(*contact.name))
      fail(contact, "must consist of letters, digits, _ and -, as columns are named by it");
    const auto [other, is_new] = first.try_emplace(
        contact.called(),
        place_of_key(contact.places, contact.where, contact.name ? "name" : "on"));
    if (!is_new)
      fail(contact, "a contact is called so already, by " + other->second);
    if (contact.heat.friction_share.value_or(0) > 0 && !contact.friction.resists())
      fail(contact,
           "heat.friction_share is a share of the heat that friction makes, but the contact has no "
           "friction; give contact.friction, or leave the share out");
  }
}

}  // namespace tourmaline::casefile
