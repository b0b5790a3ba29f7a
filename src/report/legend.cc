#include "report/legend.h"

#include <fmt/format.h>

#include <algorithm>

#include "report/number_text.h"
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
    list += (list.empty() ? "" : ", ") + (component ? component->text() : std::string("free"));
  return fmt::format("u = ({}) m", list);
}

std::string traction_text(const casefile::FormulaVector &components) {
  std::string list;
  for (const Formula &component : components)
    list += (list.empty() ? "" : ", ") + component.text();
  return fmt::format("σν = ({}) N/m²", list);
}

/// A constant with its power of ten, or the formula.
std::string text_of(const Formula &formula) {
  const bool is_constant = !formula.depends_on_time() && !formula.depends_on_place();
  return is_constant ? number_text(formula.value({}, 0), 6) : formula.text();
}

std::string compliance_text(const casefile::NormalCase &normal) {
  const std::string c = text_of(normal.coefficient);
  if (normal.exponent == 1)
    return fmt::format("compliance, p = c (u_ν − g)₊, c = {} N/m³", c);
  return fmt::format("compliance, p = c (u_ν − g)₊^{}, c = {} N/m^{}", normal.exponent, c,
                     2 + normal.exponent);
}

std::string normal_text(const casefile::NormalCase &normal) {
  if (normal.law == "compliance")
    return compliance_text(normal);
  if (normal.law == "damped")
    return fmt::format("damped contact, c = {} N s/m³", text_of(normal.coefficient));
  return normal.law + " contact";
}

std::string coefficient_text(const casefile::FrictionCoefficientCase &mu) {
  if (mu.value)
    return "μ = " + mu.value->text();
  return fmt::format(
      "μ from {} to {} over {}", mu.at_rest->text(), mu.kinetic->text(),
      mu.speed ? number_text(*mu.speed, 6) + " m/s" : number_text(*mu.distance, 6) + " m of slip");
}

std::string friction_text(const casefile::FrictionCase &friction) {
  if (friction.law == "none")
    return "no friction";
  if (friction.law == "tresca")
    return fmt::format("Tresca friction, S = {} N/m²", friction.bound.text());
  std::string text = "Coulomb friction, " + coefficient_text(friction.coefficient);
  if (!friction.cohesion.is_zero())
    text += fmt::format(", cohesion {} N/m²", friction.cohesion.text());
  if (friction.limit)
    text += fmt::format(", at most {} N/m²", friction.limit->text());
  return text;
}

void add_foundation(Conditions &conditions, const casefile::ContactCase &contact) {
  if (!contact.gap.is_zero())
    conditions.texts.push_back(fmt::format("gap g = {} m", text_of(contact.gap)));
  std::string list;
  for (const Formula &component : contact.foundation_displacement)
    list += (list.empty() ? "" : ", ") + component.text();
  if (!list.empty())
    conditions.texts.push_back(fmt::format("foundation moves by ({}) m", list));
}

void add_contact(Conditions &conditions, const casefile::ContactCase &contact,
                 const std::string &friction_name) {
  conditions.kind = "contact";
  conditions.texts.push_back(normal_text(contact.normal));
  add_foundation(conditions, contact);
  if (!friction_name.empty())
    conditions.texts.push_back(fmt::format("friction of a program: {}", friction_name));
  else
    conditions.texts.push_back(friction_text(contact.friction));
  if (contact.heat.law == "insulated")
    conditions.texts.push_back("insulated, q·ν = 0");
  else
    conditions.texts.push_back(fmt::format("heat exchange, k = {} W/(K m²), with {} K",
                                           contact.heat.coefficient.text(),
                                           contact.heat.foundation_temperature.text()));
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
      conditions.texts.push_back(fmt::format("{} = {} {}", symbol, formula->text(), unit));
  };
  scalar(entry.potential, "φ", "V");
  scalar(entry.surface_charge, "D·ν", "C/m²");
  scalar(entry.temperature, "θ", "K");
  scalar(entry.heat_flux, "q·ν", "W/m²");
}

/// Of a plane body everything holds for a metre of its depth.
std::string electrode_text(const casefile::ElectrodeCase &electrode, int dimension) {
  const bool plane = dimension == 2;
  std::string text = "electrode " + electrode.name;
  const auto add = [&](const std::string &piece) { text += ", " + piece; };
  if (electrode.voltage)
    add(electrode.voltage->text() + " V");
  if (electrode.charge)
    add("Q = " + electrode.charge->text() + (plane ? " C/m" : " C"));
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
      add_contact(conditions, contact, friction_name);
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
      conditions.texts.push_back(electrode_text(electrode, asked.dimension));
  return conditions;
}

}  // namespace tourmaline::report
