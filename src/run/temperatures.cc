#include "run/temperatures.h"

#include <fmt/format.h>

#include <cmath>

#include "body/fields.h"
#include "material/constants.h"

namespace tourmaline::run {

namespace {

using casefile::Formula;

/// [K], one for the whole body
double reference_of(const casefile::Case &asked) {
  const casefile::MaterialCase &any =
      asked.regions.empty() ? asked.material : asked.regions.front().material;
  return material::constants_of(any).reference_temperature;
}

// All temperatures that a case gives.
template <class Asked, class See>
void for_each_temperature(Asked &asked, const See &see) {
  for (auto &boundary : asked.boundaries)
    if (boundary.temperature)
      see(*boundary.temperature);
  if (asked.contact && asked.contact->heat.law == "exchange")
    see(asked.contact->heat.foundation_temperature);
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

template <int dim>
std::string temperature_warning(const solve::Model<dim> &model, std::span<const double> state) {
  const double reference = model.composition.reference_temperature();
  double largest = 0;
  for (body::Node node = 0; node < model.body.n_nodes(); ++node)
    if (const double theta = state[body::unknown<dim>(node, body::Fields<dim>::temperature)];
        std::abs(theta) > std::abs(largest))
      largest = theta;
  if (std::abs(largest) <= reference / 2)
    return "";
  return fmt::format(
      "at the end the temperature reaches {:.4g} K{}; {}, and the theory is linear, "
      "for differences far below that",
      largest, largest <= -reference ? ", which is below absolute zero" : "",
      reference_words(reference));
}

template std::string temperature_warning<2>(const solve::Model<2> &, std::span<const double>);
template std::string temperature_warning<3>(const solve::Model<3> &, std::span<const double>);

}  // namespace tourmaline::run
