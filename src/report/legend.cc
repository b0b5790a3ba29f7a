#include "report/legend.h"

#include <fmt/format.h>

#include <algorithm>

#include "contact/in_words.h"
#include "tourmaline/case/case.h"

namespace tourmaline::report {
namespace {

using casefile::Formula;

bool names(const std::vector<std::string> &list, const std::string &boundary) {
  return std::find(list.begin(), list.end(), boundary) != list.end();
}

std::string displacement_text(const std::vector<std::optional<Formula>> &components) {
  std::string list;
  for (const auto &component : components)
    list += (list.empty() ? "" : ", ") + (component ? component->in_words() : std::string("free"));
  return fmt::format("u = ({}) m", list);
}

std::string traction_text(const casefile::FormulaVector &components) {
  std::string list;
  for (const Formula &component : components)
    list += (list.empty() ? "" : ", ") + component.in_words();
  return fmt::format("σν = ({}) N/m²", list);
}

void add_contact(Conditions &conditions, const casefile::ContactCase &asked,
                 const std::string &friction_name, bool is_thermal) {
  conditions.kind = "contact";
  for (const std::string &text : contact::in_words(asked, friction_name, is_thermal))
    conditions.texts.push_back(text);
}

void add_mechanics(Conditions &conditions, const casefile::BoundaryCase &entry) {
  if (entry.displacement) {
    if (conditions.kind == "free" || conditions.kind == "traction")
      conditions.kind = "displacement";
    conditions.texts.push_back(displacement_text(*entry.displacement));
  }
  if (entry.traction) {
    if (conditions.kind == "free")
      conditions.kind = "traction";
    conditions.texts.push_back(traction_text(*entry.traction));
  }
}

void add_others(Conditions &conditions, const casefile::BoundaryCase &entry) {
  const auto scalar = [&](const std::optional<Formula> &formula, const char *symbol,
                          const char *unit) {
    if (formula)
      conditions.texts.push_back(fmt::format("{} = {} {}", symbol, formula->in_words(), unit));
  };
  scalar(entry.potential, "φ", "V");
  scalar(entry.surface_charge, "D·ν", "C/m²");
  scalar(entry.temperature, "θ", "K");
  scalar(entry.heat_flux, "q·ν", "W/m²");
}

/// Of a plane body everything holds for a metre of its depth.
std::string electrode_text(const casefile::ElectrodeCase &electrode, bool plane) {
  std::string text = "electrode " + electrode.name;
  const auto add = [&](const std::string &piece) { text += ", " + piece; };
  if (electrode.voltage)
    add(electrode.voltage->in_words() + " V");
  if (electrode.charge)
    add("Q = " + electrode.charge->in_words() + (plane ? " C/m" : " C"));
  if (electrode.resistor)
    add(fmt::format("{} {}", *electrode.resistor, plane ? "Ω m" : "Ω"));
  if (electrode.capacitor)
    add(fmt::format("{} {}", *electrode.capacitor, plane ? "F/m" : "F"));
  if (electrode.to)
    add("to " + *electrode.to);
  return text;
}

}  // namespace

Conditions conditions_on(const casefile::Case &asked, const std::string &boundary,
                         const std::string &friction_name) {
  Conditions conditions;
  for (const casefile::ContactCase &contact : asked.contacts)
    if (names(contact.on, boundary)) {
      if (asked.contacts.size() > 1)
        conditions.texts.push_back("contact " + contact.called());
      add_contact(conditions, contact, friction_name, asked.model.thermal);
    }
  const auto add_entries = [&](auto add) {
    for (const casefile::BoundaryCase &entry : asked.boundaries)
      if (names(entry.on, boundary))
        add(conditions, entry);
  };
  add_entries(add_mechanics);
  add_entries(add_others);
  for (const casefile::ElectrodeCase &electrode : asked.electrodes)
    if (names(electrode.on, boundary))
      conditions.texts.push_back(electrode_text(electrode, asked.is_per_depth()));
  return conditions;
}

}  // namespace tourmaline::report
