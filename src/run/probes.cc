#include "run/probes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "case/probes.h"
#include "tourmaline/error.h"

namespace tourmaline::run {

namespace {

constexpr const char *directions[] = {"x", "y", "z"};

Vector3 in_space(const std::vector<double> &place) {
  Vector3 all{};
  std::copy(place.begin(), place.end(), all.begin());
  return all;
}

// As in a case file, with digits enough for it to lie in the body when it is given there.
std::string words(int dimension, const Vector3 &place) {
  std::string text;
  for (int axis = 0; axis < dimension; ++axis)
    text += fmt::format("{}{:.12g}", axis == 0 ? "[" : ", ", place[axis] == 0 ? 0. : place[axis]);
  return text + "]";
}

std::vector<Vector3> line(const Vector3 &from, const Vector3 &to, int points) {
  std::vector<Vector3> all;
  for (int i = 0; i < points; ++i) {
    const double share = static_cast<double>(i) / (points - 1);
    Vector3 &place = all.emplace_back();
    for (std::size_t axis = 0; axis < 3; ++axis)
      place[axis] = (1 - share) * from[axis] + share * to[axis];
  }
  return all;
}

[[noreturn]] void fail(int dimension, const casefile::ProbeCase &probe, std::size_t number,
                       const Vector3 &asked, const body::Interpolation &nearest) {
  const std::string place = words(dimension, asked),
                    what = probe.at ? fmt::format("at = {}: this place", place)
                                    : fmt::format("from: place {} of the {} on this line, {},",
                                                  number + 1, *probe.points, place);
  throw CaseError(
      fmt::format("{} {} lies outside of the body; the nearest place in it is {}, {:.3g} m away",
                  probe.where, what, words(dimension, nearest.place), nearest.distance));
}

}  // namespace

template <int dim>
double Probes<dim>::Places::along(std::size_t i) const {
  return std::hypot(at[i][0] - at[0][0], at[i][1] - at[0][1], at[i][2] - at[0][2]);
}

template <int dim>
typename Probes<dim>::Places Probes<dim>::places_of(const casefile::ProbeCase &probe) {
  if (probe.at)
    return {probe.name, false, {in_space(*probe.at)}, {}};
  return {probe.name, true, line(in_space(*probe.from), in_space(*probe.to), *probe.points), {}};
}

template <int dim>
Probes<dim>::Probes(const solve::Model<dim> &model) : model_(model) {
  find_places();
  for (const casefile::ProbeCase &probe : model.asked.probes)
    if (probe.on)
      boundaries_.push_back({probe.name, in_space(probe.about), {model, *probe.on}});
  find_regions();
}

template <int dim>
void Probes<dim>::find_regions() {
  const std::vector<casefile::RegionCase> &all = model_.asked.regions;
  for (const casefile::ProbeCase &probe : model_.asked.probes) {
    if (!probe.region)
      continue;
    std::vector<std::size_t> numbers;
    for (std::size_t i = 0; i < all.size(); ++i)
      if (std::find(probe.region->begin(), probe.region->end(), called(all[i])) !=
          probe.region->end())
        numbers.push_back(i);
    regions_.push_back({probe.name, {model_.body, model_.asked.model, numbers}});
  }
}

template <int dim>
void Probes<dim>::find_places() {
  std::vector<const casefile::ProbeCase *> asked;
  std::vector<Vector3> all;
  for (const casefile::ProbeCase &probe : model_.asked.probes)
    if (probe.at || probe.from) {
      asked.push_back(&probe);
      const Places &places = places_.emplace_back(places_of(probe));
      all.insert(all.end(), places.at.begin(), places.at.end());
    }
  if (all.empty())
    return;
  const std::vector<body::Interpolation> found = body::nearest_places(model_.body, all);
  auto next = found.begin();
  for (std::size_t i = 0; i < places_.size(); ++i)
    for (std::size_t p = 0; p < places_[i].at.size(); ++p, ++next) {
      if (next->distance > 0)
        fail(dim, *asked[i], p, places_[i].at[p], *next);
      places_[i].fields.push_back(*next);
    }
}

template <int dim>
output::ProbeRows Probes<dim>::rows_of(const Places &probe, std::span<const double> state) const {
  output::ProbeRows rows{probe.name, {}, {}};
  if (probe.is_line)
    rows.columns.emplace_back("s");
  rows.columns.insert(rows.columns.end(), directions, directions + dim);
  std::vector<int> components;
  for (int c = 0; c < body::Fields<dim>::count; ++c)
    if (const std::string column = body::column_of<dim>(c); model_.asked.model.has(column)) {
      components.push_back(c);
      rows.columns.push_back(column);
    }
  std::vector<double> values;  // place by place
  for (const body::Interpolation &place : probe.fields)
    for (const int c : components)
      values.push_back(place.template value<dim>(state, c));
  model_.sharing().sum(values);
  auto next = values.begin();
  for (std::size_t i = 0; i < probe.at.size(); ++i) {
    std::vector<double> &row = rows.rows.emplace_back();
    if (probe.is_line)
      row.push_back(probe.along(i));
    row.insert(row.end(), probe.at[i].begin(), probe.at[i].begin() + dim);
    row.insert(row.end(), next, next + static_cast<std::ptrdiff_t>(components.size()));
    next += static_cast<std::ptrdiff_t>(components.size());
  }
  return rows;
}

template <int dim>
output::ProbeRows Probes<dim>::rows_of(const Boundaries &probe,
                                       const solve::BoundaryFlow &flow) const {
  output::ProbeRows rows{probe.name, {}, {{}}};
  const auto put = [&](const std::string &column, double value) {
    rows.columns.push_back(column);
    rows.rows[0].push_back(value);
  };
  for (int c = 0; c < dim; ++c)
    put(std::string("force_") + directions[c], flow.force[c]);
  const casefile::ModelCase &model = model_.asked.model;
  for (int c = dim == 2 ? 2 : 0; c < 3 && !model.is_axisymmetric(); ++c)
    put(std::string("moment_") + directions[c], flow.moment[c]);
  if (model.electric)
    put("charge", flow.charge);
  if (model.thermal)
    put("heat", flow.heat);
  put("area", probe.part.area());
  return rows;
}

template <int dim>
output::ProbeRows Probes<dim>::rows_of(const Regions &probe, std::span<const double> state,
                                       const std::vector<body::Energies> &stored) {
  output::ProbeRows rows{probe.name, {}, {{}}};
  for (const auto &[column, value] : probe.part.columns(state, stored)) {
    rows.columns.push_back(column);
    rows.rows[0].push_back(value);
  }
  return rows;
}

template <int dim>
std::vector<output::ProbeRows> Probes<dim>::rows(double time,
                                                 std::span<const solve::Passage> passages,
                                                 std::span<const double> state) const {
  std::vector<output::ProbeRows> all;
  for (const Places &probe : places_)
    all.push_back(rows_of(probe, state));
  for (const Boundaries &probe : boundaries_)
    all.push_back(rows_of(probe, probe.part.flow(time, passages, state, probe.about)));
  if (regions_.empty())
    return all;
  const std::vector<body::Energies> stored =
      model_.cells.stored(state, model_.asked.regions.size());
  for (const Regions &probe : regions_)
    all.push_back(rows_of(probe, state, stored));
  return all;
}

template class Probes<2>;
template class Probes<3>;

}  // namespace tourmaline::run
