#include "contact/in_words.h"

#include <fmt/format.h>

#include "contact/kinds.h"
#include "contact/values.h"

namespace tourmaline::contact {

namespace {

using casefile::Formula;

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
  if (!heat.exchanges())
    return "insulated, q·ν = 0";
  return fmt::format("heat exchange, k = {} W/(K m²), with {} K", heat.coefficient.text(),
                     heat.foundation_temperature.text());
}

}  // namespace

std::vector<std::string> in_words(const casefile::ContactCase &asked,
                                  const std::string &friction_name) {
  std::vector<std::string> words{kind_of(asked.normal).words(asked.normal)};
  add_foundation(asked, words);
  words.push_back(friction_name.empty() ? kind_of(asked.friction).words(asked.friction)
                                        : "friction of a program: " + friction_name);
  words.push_back(heat_text(asked.heat));
  return words;
}

}  // namespace tourmaline::contact
