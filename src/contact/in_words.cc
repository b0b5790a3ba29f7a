#include "contact/in_words.h"

#include <fmt/format.h>

#include "printed_number.h"

namespace tourmaline::contact {

namespace {

using casefile::Formula;

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

void add_foundation(const casefile::ContactCase &asked, std::vector<std::string> &words) {
  if (!asked.gap.is_zero())
    words.push_back(fmt::format("gap g = {} m", text_of(asked.gap)));
  std::string list;
  for (const Formula &component : asked.foundation_displacement)
    list += (list.empty() ? "" : ", ") + component.text();
  if (!list.empty())
    words.push_back(fmt::format("foundation moves by ({}) m", list));
}

std::string heat_text(const casefile::HeatExchangeCase &heat) {
  std::string text = heat.exchanges()
                         ? fmt::format("heat exchange, k = {} W/(K m²), with {} K",
                                       heat.coefficient.text(), heat.foundation_temperature.text())
                         : "insulated, q·ν = 0";
  if (heat.pressure)
    text += fmt::format(", and {} (p/({} N/m²))^{}", heat.pressure->coefficient.text(),
                        number_text(heat.pressure->reference, 6), heat.pressure->exponent);
  if (heat.ramp)
    text += fmt::format(", k fading over {} m", number_text(*heat.ramp, 6));
  if (heat.friction_share)
    text += fmt::format(", {} of the heat of friction", *heat.friction_share);
  return text;
}

std::string charge_text(const casefile::ChargeExchangeCase &electric) {
  std::string text = fmt::format(
      "{}, c = {} {}, with {} V", electric.law == "leak" ? "leaking charge" : "charge exchange",
      text_of(electric.coefficient), electric.law == "leak" ? "S/m²" : "F/m²",
      electric.foundation_potential.text());
  if (electric.ramp)
    text += fmt::format(", fading over {} m", number_text(*electric.ramp, 6));
  return text;
}

}  // namespace

std::vector<std::string> in_words(const casefile::ContactCase &asked,
                                  const std::string &friction_name) {
  std::vector<std::string> words{normal_text(asked.normal)};
  add_foundation(asked, words);
  words.push_back(friction_name.empty() ? friction_text(asked.friction)
                                        : "friction of a program: " + friction_name);
  words.push_back(heat_text(asked.heat));
  if (asked.electric.exchanges())
    words.push_back(charge_text(asked.electric));
  return words;
}

}  // namespace tourmaline::contact
