#include "run/probes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "body/fields.h"
#include "case/toml_text.h"
#include "tourmaline/case/case.h"
#include "tourmaline/error.h"

namespace tourmaline::run {

namespace {

Vector3 in_space(const std::vector<double> &place) {
  Vector3 point{};
  std::copy(place.begin(), place.end(), point.begin());
  return point;
}

double distance(const Vector3 &a, const Vector3 &b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

output::ProbeRows places_of(const casefile::ProbeCase &probe) {
  if (!probe.is_line())
    return {{in_space(*probe.at)}, {}, {}};
  const Vector3 from = in_space(*probe.from), to = in_space(*probe.to);
  output::ProbeRows rows;
  for (int i = 0; i < probe.points; ++i) {
    const double share = i / (probe.points - 1.);
    Vector3 &place = rows.places.emplace_back();
    for (std::size_t axis = 0; axis < 3; ++axis)
      place[axis] = (1 - share) * from[axis] + share * to[axis];
    rows.distances.push_back(share * distance(from, to));
  }
  return rows;
}

std::string words(int dimension, const Vector3 &place) {
  return dimension == 2 ? fmt::format("({:g}, {:g}) m", place[0], place[1])
                        : fmt::format("({:g}, {:g}, {:g}) m", place[0], place[1], place[2]);
}

[[noreturn]] void refuse(const casefile::ProbeCase &probe, int dimension, const Vector3 &place,
                         const std::vector<Vector3> &nodes) {
  const auto nearest = std::min_element(
      nodes.begin(), nodes.end(),
      [&](const Vector3 &a, const Vector3 &b) { return distance(a, place) < distance(b, place); });
  throw CaseError(fmt::format("{} {}: {} is outside of the body; its nearest node is at {}",
                              probe.where, casefile::toml_text(probe.name), words(dimension, place),
                              words(dimension, *nearest)));
}

}  // namespace

template <int dim>
Probes<dim>::Probes(const body::Discretisation<dim> &body, const casefile::Case &asked) {
  for (const casefile::ProbeCase &probe : asked.probes) {
    Probe &added = all_.emplace_back(Probe{probe.name, places_of(probe), {}});
    added.shares = body.shares_at(added.rows.places);
    for (std::size_t i = 0; i < added.shares.size(); ++i)
      if (added.shares[i].nodes.empty())
        refuse(probe, dim, added.rows.places[i], body.points());
  }
}

template <int dim>
output::ProbeRows Probes<dim>::rows(const Probe &probe, std::span<const double> state) {
  using Fields = body::Fields<dim>;
  output::ProbeRows rows = probe.rows;
  for (const body::NodeShares &at : probe.shares) {
    std::array<double, Fields::count> values{};
    for (std::size_t a = 0; a < at.nodes.size(); ++a)
      for (int c = 0; c < Fields::count; ++c)
        values[static_cast<std::size_t>(c)] +=
            at.shares[a] * state[body::unknown<dim>(at.nodes[a], c)];
    Vector3 displacement{};
    std::copy_n(values.begin(), dim, displacement.begin());
    rows.values.displacement.push_back(displacement);
    rows.values.potential.push_back(values[Fields::potential]);
    rows.values.temperature.push_back(values[Fields::temperature]);
  }
  return rows;
}

template class Probes<2>;
template class Probes<3>;

}  // namespace tourmaline::run
