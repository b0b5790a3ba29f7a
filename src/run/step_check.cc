#include "run/step_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tourmaline/error.h"

namespace tourmaline::run {

namespace {

std::string at(const Vector3 &p) {
  return fmt::format(" at ({:g}, {:g}, {:g})", p[0], p[1], p[2]);
}

Vector3 centre(const output::Grid &grid, std::size_t cell) {
  Vector3 sum{};
  for (std::size_t a = 0; a < grid.nodes_per_cell; ++a)
    for (int axis = 0; axis < 3; ++axis)
      sum[axis] += grid.points[grid.connectivity[cell * grid.nodes_per_cell + a]][axis] /
                   static_cast<double>(grid.nodes_per_cell);
  return sum;
}

// The first number that is not finite, or the end.
std::span<const double>::iterator first_wrong(std::span<const double> numbers) {
  return std::find_if(numbers.begin(), numbers.end(), [](double v) { return !std::isfinite(v); });
}

}  // namespace

void StepCheck::refuse(const std::string &what, double value) const {
  throw SolveError(fmt::format(
      "step {}, t = {:g} s: {} is {}, so nothing of this step was written; some product of its "
      "numbers exceeds what a double holds (1.8e308): look for a load, a prescribed value, a "
      "material constant or a circuit element that is too large or too small by many powers of "
      "ten, often a unit (`tourmaline check` shows them)",
      step_, time_, what, std::isnan(value) ? "not a number" : "infinite"));
}

void StepCheck::unknowns(int dimension, const std::vector<Vector3> &places,
                         std::span<const double> values, const char *const names[3]) const {
  const auto wrong = first_wrong(values);
  if (wrong == values.end())
    return;
  const auto i = static_cast<std::size_t>(wrong - values.begin());
  const int component = static_cast<int>(i % (dimension + 2));
  refuse(names[std::max(0, component - dimension + 1)] + at(places[i / (dimension + 2)]), *wrong);
}

void StepCheck::state(int dimension, const std::vector<Vector3> &places,
                      std::span<const double> state) const {
  constexpr const char *names[] = {"the displacement", "the potential", "the temperature"};
  unknowns(dimension, places, state, names);
}

void StepCheck::loads(int dimension, const std::vector<Vector3> &places,
                      std::span<const double> loads) const {
  constexpr const char *names[] = {"the load", "the charge given", "the heat given"};
  unknowns(dimension, places, loads, names);
}

void StepCheck::contact(const std::vector<output::ContactRow> &rows) const {
  for (const output::ContactRow &row : rows) {
    const std::pair<const char *, std::span<const double>> numbers[] = {
        {"the contact's normal traction", {&row.normal_traction, 1}},
        {"the contact's tangential traction", row.tangential_traction},
        {"the contact's normal displacement", {&row.normal_displacement, 1}},
        {"the contact's slip", row.slip},
        {"the contact's slip rate", {&row.slip_rate, 1}},
        {"the contact's temperature", {&row.temperature, 1}},
        {"the contact's potential", {&row.potential, 1}},
        {"the contact's heat flux", {&row.heat_flux, 1}},
        {"the contact's gap", {&row.gap, 1}}};
    for (const auto &[name, values] : numbers)
      if (const auto wrong = first_wrong(values); wrong != values.end())
        refuse(name + at(row.point), *wrong);
  }
}

namespace {

// Numbers of a field cell by cell, as one row of doubles.
template <std::size_t n>
std::span<const double> flat(const std::vector<std::array<double, n>> &values) {
  return values.empty() ? std::span<const double>()
                        : std::span(values.front().data(), n * values.size());
}

}  // namespace

void StepCheck::fields(const output::Grid &grid, const output::CellFields &fields) const {
  const std::tuple<const char *, std::span<const double>, std::size_t> all[] = {
      {"the strain", flat(fields.strain), 6},
      {"the stress", flat(fields.stress), 6},
      {"the principal stress", flat(fields.principal_stress), 3},
      {"the von Mises stress", fields.von_mises, 1},
      {"the electric displacement", flat(fields.electric_displacement), 3},
      {"the heat flux", flat(fields.heat_flux), 3}};
  for (const auto &[name, values, n] : all)
    if (const auto wrong = first_wrong(values); wrong != values.end())
      refuse(name + at(centre(grid, static_cast<std::size_t>(wrong - values.begin()) / n)), *wrong);
}

void StepCheck::quantities(const std::vector<std::pair<std::string, double>> &columns) const {
  for (const auto &[name, value] : columns)
    if (!std::isfinite(value))
      refuse(name + " (history.csv)", value);
}

}  // namespace tourmaline::run
