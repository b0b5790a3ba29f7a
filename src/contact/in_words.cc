#include "contact/in_words.h"

#include <fmt/format.h>

#include "contact/kinds.h"
#include "contact/values.h"
#include "printed_number.h"

namespace tourmaline::contact {

namespace {

using casefile::Formula;

void add_foundation(const casefile::ContactCase &asked, std::vector<std::string> &words) {
  if (!asked.gap.is_zero())
    words.push_back(fmt::format("gap g = {} m", text_of(asked.gap)));
  std::string list;
  for (const Formula &component : asked.foundation_displacement)
    list += (list.empty() ? "" : ", ") + component.in_words();
  if (!list.empty())
    words.push_back(fmt::format("foundation moves by ({}) m", list));
}

std::string heat_text(const casefile::HeatExchangeCase &heat) {
  std::string text = heat.exchanges() ? fmt::format("heat exchange, k = {} W/(K m²), with {} K",
                                                    heat.coefficient.in_words(),
                                                    heat.foundation_temperature.in_words())
                                      : "insulated, q·ν = 0";
  if (heat.pressure)
    text += fmt::format(", and {} (p/({} N/m²))^{}", heat.pressure->coefficient.in_words(),
                        number_text(heat.pressure->reference, 6), heat.pressure->exponent);
  if (heat.ramp)
    text += fmt::format(", k fading over {} m", number_text(*heat.ramp, 6));
  if (heat.friction_share)
    text += fmt::format(", {} of the heat of friction", *heat.friction_share);
  return text;
}

std::string circuit_text(const casefile::FoundationCircuitCase &circuit) {
  std::string text = "a foundation ";
  if (circuit.charge)
    return text + "with the charge " + circuit.charge->in_words() + " C";
  if (!circuit.is_loaded())
    return text + "that is open";
  text += "behind ";
  if (circuit.resistor)
    text += number_text(*circuit.resistor, 6) + " Ω";
  if (circuit.capacitor)
    text += (circuit.resistor ? " and " : "") + number_text(*circuit.capacitor, 6) + " F";
  return text + " to " + circuit.voltage.in_words() + " V";
}

std::string charge_text(const casefile::ChargeExchangeCase &electric) {
  std::string text = fmt::format(
      "{}, c = {} {}, with {}", electric.law == "leak" ? "leaking charge" : "charge exchange",
      text_of(electric.coefficient), electric.law == "leak" ? "S/m²" : "F/m²",
      electric.circuit ? circuit_text(*electric.circuit)
                       : electric.foundation_potential->in_words() + " V");
  if (electric.ramp)
    text += fmt::format(", fading over {} m", number_text(*electric.ramp, 6));
  return text;
}

}  // namespace

std::vector<std::string> in_words(const casefile::ContactCase &asked,
                                  const std::string &friction_name, bool is_thermal) {
  std::vector<std::string> words{kind_of(asked.normal).words(asked.normal)};
  add_foundation(asked, words);
  words.push_back(friction_name.empty() ? kind_of(asked.friction).words(asked.friction)
                                        : "friction of a program: " + friction_name);
  if (is_thermal)
    words.push_back(heat_text(asked.heat));
  if (asked.electric.exchanges())
    words.push_back(charge_text(asked.electric));
  return words;
}

}  // namespace tourmaline::contact
