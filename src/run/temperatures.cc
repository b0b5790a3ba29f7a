#include "run/temperatures.h"

#include <fmt/format.h>

#include <cmath>

#include "material/composition.h"

namespace tourmaline::run {

namespace {

using casefile::Formula;

/// [K], one for the whole body
double reference_of(const casefile::Case &asked) {
  return material::constants_of(material::materials_of(asked).front()).reference_temperature;
}

// All temperatures that a case gives.
template <class Asked, class See>
void for_each_temperature(Asked &asked, const See &see) {
  for (auto &boundary : asked.boundaries)
    if (boundary.temperature)
      see(*boundary.temperature);
  for (auto &contact : asked.contacts)
    see(contact.heat.foundation_temperature);
  see(asked.initial.temperature);
}

std::string reference_words(double reference) {
  return fmt::format("temperatures are differences to the reference temperature, {:g} K",
                     reference);
}

}  // namespace

std::vector<std::string> temperature_warnings(const casefile::Case &asked) {
  const double reference = reference_of(asked);
  std::vector<std::string> all;
  for_each_temperature(asked, [&](const Formula &temperature) {
    const double value = temperature.is_number() ? temperature.value({}, 0) : 0;
    if (std::abs(value) > reference / 2)
      all.push_back(fmt::format(
          "{} = {} K: {}; {}", temperature.where(), temperature.text(), reference_words(reference),
          value <= -reference ? "this is below absolute zero" : "is an absolute one meant?"));
  });
  return all;
}

void TemperaturePeak::see(double temperature, int n, double time) {
  if (std::abs(temperature) <= std::abs(value_))
    return;
  value_ = temperature;
  step_ = n;
  time_ = time;
}

void TemperaturePeak::begin(const std::vector<output::Extreme> &extremes) {
  for (const output::Extreme &extreme : extremes)
    if (extreme.field == "temperature") {
      see(extreme.minimum, 0, 0);
      see(extreme.maximum, 0, 0);
    }
}

void TemperaturePeak::step(const output::HistoryRow &row) {
  for (const auto &[name, value] : row.quantities)
    if (name == "min_temperature" || name == "max_temperature")
      see(value, row.step, row.time);
}

std::string TemperaturePeak::warning(double reference) const {
  if (std::abs(value_) <= reference / 2)
    return "";
  return fmt::format(
      "the temperature reaches {:.4g} K{} (step {}, t = {:g} s); {}, and the theory is linear, for "
      "differences far below that",
      value_, value_ <= -reference ? ", which is below absolute zero" : "", step_, time_,
      reference_words(reference));
}

void TemperaturePeak::save(output::SavedNumbers &numbers) const {
  numbers.put("farthest temperature", {value_, static_cast<double>(step_), time_});
}

void TemperaturePeak::restore(const output::SavedNumbers &numbers) {
  const auto saved = numbers.get("farthest temperature", 3);
  value_ = saved[0];
  step_ = static_cast<int>(saved[1]);
  time_ = saved[2];
}

}  // namespace tourmaline::run
