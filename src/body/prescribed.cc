#include "body/prescribed.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "tourmaline/error.h"

namespace tourmaline::body {

template <int dim>
std::vector<Prescribed> prescribed_unknowns(
    const Discretisation<dim> &body, const std::vector<casefile::BoundaryCase> &boundaries,
    const std::vector<casefile::ElectrodeCase> &electrodes) {
  std::map<std::size_t, Prescribed> by_unknown;
  for (const casefile::BoundaryCase &boundary : boundaries)
    for (const std::string &name : boundary.on)
      for (const Node node : body.nodes_on({name})) {
        const auto prescribe = [&](int component, const casefile::Formula &value) {
          const std::size_t i = unknown<dim>(node, component);
          by_unknown.try_emplace(i, Prescribed{i, body.points()[node], value, name});
        };
        for (int c = 0; boundary.displacement && c < dim; ++c)
          if (const auto &component = (*boundary.displacement)[c])
            prescribe(c, *component);
        if (boundary.potential)
          prescribe(Fields<dim>::potential, *boundary.potential);
        if (boundary.temperature)
          prescribe(Fields<dim>::temperature, *boundary.temperature);
      }
  for (std::size_t e = 0; e < electrodes.size(); ++e)
    for (const Node node : body.nodes_on(electrodes[e].on)) {
      const std::size_t i = unknown<dim>(node, Fields<dim>::potential);
      by_unknown.try_emplace(
          i, Prescribed{i, body.points()[node],
                        electrodes[e].is_driven() ? *electrodes[e].voltage : casefile::Formula(0.),
                        electrodes[e].name, static_cast<int>(e)});
    }
  std::vector<Prescribed> all;
  for (auto &[i, prescribed] : by_unknown)
    all.push_back(std::move(prescribed));
  return all;
}

template <int dim>
std::vector<Prescribed> with_all_temperatures(const Discretisation<dim> &body,
                                              std::vector<Prescribed> prescribed) {
  std::vector<bool> mask = mask_of(prescribed, body.n_nodes() * Fields<dim>::count);
  for (Node node = 0; node < body.n_nodes(); ++node)
    if (const std::size_t i = unknown<dim>(node, Fields<dim>::temperature); !mask[i])
      prescribed.push_back({i, body.points()[node], casefile::Formula(0.), ""});
  std::sort(prescribed.begin(), prescribed.end(),
            [](const Prescribed &a, const Prescribed &b) { return a.unknown < b.unknown; });
  return prescribed;
}

template <int dim>
std::vector<std::vector<Node>> electrode_nodes(
    const std::vector<Prescribed> &prescribed,
    const std::vector<casefile::ElectrodeCase> &electrodes) {
  std::vector<std::vector<Node>> nodes(electrodes.size());
  for (const Prescribed &p : prescribed)
    if (p.electrode >= 0)
      nodes[p.electrode].push_back(static_cast<Node>(p.unknown / Fields<dim>::count));
  for (std::size_t e = 0; e < electrodes.size(); ++e)
    if (nodes[e].empty())
      throw CaseError(
          fmt::format("{} \"{}\": other conditions stand first at all nodes of this electrode",
                      electrodes[e].where, electrodes[e].name));
  return nodes;
}

template <int dim>
std::vector<double> initial_state(const Discretisation<dim> &body,
                                  const casefile::InitialCase &initial) {
  std::vector<double> state(body.n_nodes() * Fields<dim>::count, 0.);
  for (Node node = 0; node < body.n_nodes(); ++node) {
    const Vector3 &point = body.points()[node];
    for (int c = 0; c < dim && !initial.displacement.empty(); ++c)
      state[unknown<dim>(node, c)] = initial.displacement[c].value(point, 0);
    state[unknown<dim>(node, Fields<dim>::potential)] = initial.potential.value(point, 0);
    state[unknown<dim>(node, Fields<dim>::temperature)] = initial.temperature.value(point, 0);
  }
  return state;
}

std::vector<bool> mask_of(const std::vector<Prescribed> &prescribed, std::size_t n_unknowns) {
  std::vector<bool> mask(n_unknowns, false);
  for (const Prescribed &p : prescribed)
    mask[p.unknown] = true;
  return mask;
}

template std::vector<Prescribed> prescribed_unknowns<2>(
    const Discretisation<2> &, const std::vector<casefile::BoundaryCase> &,
    const std::vector<casefile::ElectrodeCase> &);
template std::vector<Prescribed> prescribed_unknowns<3>(
    const Discretisation<3> &, const std::vector<casefile::BoundaryCase> &,
    const std::vector<casefile::ElectrodeCase> &);
template std::vector<Prescribed> with_all_temperatures<2>(const Discretisation<2> &,
                                                          std::vector<Prescribed>);
template std::vector<Prescribed> with_all_temperatures<3>(const Discretisation<3> &,
                                                          std::vector<Prescribed>);
template std::vector<std::vector<Node>> electrode_nodes<2>(
    const std::vector<Prescribed> &, const std::vector<casefile::ElectrodeCase> &);
template std::vector<std::vector<Node>> electrode_nodes<3>(
    const std::vector<Prescribed> &, const std::vector<casefile::ElectrodeCase> &);
template std::vector<double> initial_state<2>(const Discretisation<2> &,
                                              const casefile::InitialCase &);
template std::vector<double> initial_state<3>(const Discretisation<3> &,
                                              const casefile::InitialCase &);

}  // namespace tourmaline::body
