#include "case/regime.h"

#include <fmt/format.h>

#include <algorithm>

#include "tourmaline/case/case.h"
#include "tourmaline/error.h"

namespace tourmaline::casefile {

namespace {

[[noreturn]] void refuse_without_time(const std::string &place, const std::string &what,
                                      const std::string &instead) {
  throw CaseError(
      fmt::format("{}: {} has a rate and is not available with time.regime = \"static\"; {}", place,
                  what, instead));
}

constexpr const char *take_time = "take \"quasistatic\"";

void check(const Case &asked, const ContactCase &contact) {
  const std::string place = asked.source + " [contact]";
  if (contact.normal.depends_on_rate())
    refuse_without_time(place, fmt::format("normal = \"{}\"", contact.normal.law), take_time);
  if (contact.friction.coefficient.speed)
    refuse_without_time(place, "a coefficient of friction that falls with the slip rate (`speed`)",
                        "take \"quasistatic\", or let it fall with the slip (`distance`)");
  if (contact.heat.friction_share.value_or(0) > 0)
    refuse_without_time(place, "heat of friction (`friction_share`)", take_time);
  if (contact.electric.law == "leak")
    refuse_without_time(place, "electric = \"leak\"", take_time);
  if (contact.electric.circuit && contact.electric.circuit->resistor)
    refuse_without_time(place, "what flows in the resistor of electric.circuit",
                        "take \"quasistatic\", or leave the foundation open");
  if (contact.heat.pressure || contact.heat.ramp)
    throw CaseError(fmt::format(
        "{}: heat that crosses by the contact's state (`{}`) is not available with time.regime = "
        "\"static\"; take \"quasistatic\" over a long time",
        place, contact.heat.pressure ? "pressure" : "ramp"));
}

// What warms a body that keeps its temperature; empty: nothing.
std::string source_of_heat(const Case &asked) {
  if (!asked.load.heat.is_zero())
    return "[load] heat";
  for (const BoundaryCase &boundary : asked.boundaries)
    if (boundary.heat_flux && !boundary.heat_flux->is_zero())
      return "[[boundary]] heat_flux";
  return "";
}

}  // namespace

bool keeps_temperature(const Case &asked) {
  return asked.time.is_static() &&
         std::none_of(asked.boundaries.begin(), asked.boundaries.end(),
                      [](const BoundaryCase &boundary) { return boundary.temperature; }) &&
         std::none_of(asked.contacts.begin(), asked.contacts.end(),
                      [](const ContactCase &contact) { return contact.heat.exchanges(); });
}

void check_regime(const Case &asked) {
  if (!asked.time.is_static())
    return;
  for (const ContactCase &contact : asked.contacts)
    check(asked, contact);
  for (const ElectrodeCase &electrode : asked.electrodes)
    if (electrode.resistor)
      refuse_without_time(fmt::format("{} \"{}\"", electrode.where, electrode.name),
                          "what flows in a resistor",
                          "take \"quasistatic\", or leave the electrode open");
  if (!keeps_temperature(asked))
    return;
  if (asked.initial.temperature.depends_on_place())
    throw CaseError(fmt::format(
        "{}: nothing holds the temperature (no boundary prescribes one, no contact exchanges "
        "heat), "
        "so that with time.regime = \"static\" it stays at its initial one, which must then be a "
        "number; or give `temperature` on a boundary",
        asked.initial.temperature.where()));
  if (const std::string source = source_of_heat(asked); !source.empty())
    throw CaseError(fmt::format(
        "{}: {} warms a body whose temperature nothing holds (no boundary prescribes one, no "
        "contact exchanges heat), so that with time.regime = \"static\" it has no steady "
        "temperature; give `temperature` on a boundary",
        asked.source, source));
}

}  // namespace tourmaline::casefile
