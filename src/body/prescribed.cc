#include "body/prescribed.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <set>

#include "case/time_steps.h"
#include "case/toml_text.h"
#include "parallel/ranks.h"
#include "tourmaline/case/case.h"
#include "tourmaline/error.h"

namespace tourmaline::body {

namespace {

template <int dim>
std::vector<Node> nodes_of(const Discretisation<dim> &body,
                           const casefile::ElectrodeCase &electrode) {
  std::vector<Node> nodes = body.nodes_on(electrode.on);
  if (!electrode.inside)
    return nodes;
  const std::vector<Node> inside = body.nodes_inside(
      [&](const Vector3 &corner) { return electrode.inside->value(corner, 0) != 0; });
  if (inside.empty())
    throw CaseError(fmt::format(
        "{} = {}: is 0 at a corner of every facet between cells, so the electrode \"{}\" covers "
        "none; cells must meet where it lies, and round-off be allowed for, as in \"abs(y - 0.01) "
        "< "
        "1e-6\"",
        electrode.inside->where(), casefile::toml_text(electrode.inside->text()), electrode.name));
  nodes.insert(nodes.end(), inside.begin(), inside.end());
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

// Facets in two electrodes would be silently the first one's; where electrodes only meet or cross,
// each has facets of its own. `nodes`: by electrode, ascending.
template <int dim>
void require_apart(const Discretisation<dim> &body,
                   const std::vector<casefile::ElectrodeCase> &electrodes,
                   const std::vector<std::vector<Node>> &nodes) {
  for (std::size_t e = 0; e < nodes.size(); ++e)
    for (std::size_t before = 0; before < e; ++before) {
      const auto &one = electrodes[before].inside, &other = electrodes[e].inside;
      std::vector<Node> shared;
      std::ranges::set_intersection(nodes[before], nodes[e], std::back_inserter(shared));
      if (!one || !other || shared.size() < dim)
        continue;
      const auto in_both = [&](const Vector3 &corner) {
        return one->value(corner, 0) != 0 && other->value(corner, 0) != 0;
      };
      if (!body.nodes_inside(in_both).empty())
        throw CaseError(fmt::format(
            "{} = {}: the electrode \"{}\" covers facets between cells that the electrode \"{}\" "
            "covers as well; each can have one, so let their `where` hold at different places",
            other->where(), casefile::toml_text(other->text()), electrodes[e].name,
            electrodes[before].name));
    }
}

}  // namespace

template <int dim>
std::vector<Node> nodes_with_conditions(const Discretisation<dim> &body,
                                        const casefile::Case &asked) {
  std::set<Node> nodes;
  const auto add = [&](const std::vector<Node> &some) { nodes.insert(some.begin(), some.end()); };
  for (const casefile::BoundaryCase &boundary : asked.boundaries)
    if (boundary.displacement || boundary.potential)
      add(body.nodes_on(boundary.on));
  for (const casefile::ContactCase &contact : asked.contacts)
    add(body.nodes_on(contact.on));
  for (const casefile::ElectrodeCase &electrode : asked.electrodes)
    add(nodes_of(body, electrode));
  for (Node node = 0; node < body.n_nodes() && body.is_on_axis(node); ++node)
    nodes.insert(node);
  return {nodes.begin(), nodes.end()};
}

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
  std::vector<std::vector<Node>> covered;
  for (const casefile::ElectrodeCase &electrode : electrodes)
    covered.push_back(nodes_of(body, electrode));
  require_apart(body, electrodes, covered);
  for (std::size_t e = 0; e < electrodes.size(); ++e)
    for (const Node node : covered[e]) {
      const std::size_t i = unknown<dim>(node, Fields<dim>::potential);
      by_unknown.try_emplace(
          i, Prescribed{i, body.points()[node],
                        electrodes[e].is_driven() ? *electrodes[e].voltage : casefile::Formula(0.),
                        electrodes[e].name, static_cast<int>(e)});
    }
  for (Node node = 0; node < body.n_nodes() && body.is_on_axis(node); ++node) {
    const std::size_t i = unknown<dim>(node, 0);
    by_unknown.try_emplace(i, Prescribed{i, body.points()[node], casefile::Formula(0.), "axis"});
  }
  std::vector<Prescribed> all;
  for (auto &[i, prescribed] : by_unknown)
    all.push_back(std::move(prescribed));
  return all;
}

namespace {

template <int dim>
bool lies_on_axis(const Discretisation<dim> &body, const std::string &boundary) {
  if (body.geometry() != Geometry::revolved)
    return false;
  const auto n_nodes = static_cast<double>(body.nodes_on({boundary}).size());
  return body.sharing().sum(n_nodes) == 0;
}

bool says_more_than_displacement_along_x(const casefile::BoundaryCase &boundary) {
  return boundary.potential || boundary.temperature || boundary.traction ||
         boundary.surface_charge || boundary.heat_flux ||
         (boundary.displacement && (*boundary.displacement)[1]);
}

[[noreturn]] void refuse_on_axis(const std::string &where, const std::string &name) {
  throw CaseError(fmt::format(
      "{}: the boundary {} lies on the axis of the body, x = 0, where it has no area, so that no "
      "more than a displacement of 0 along x can be said of it; leave out the rest",
      where, casefile::toml_text(name)));
}

// At the start and at the ends of so many steps; nodes on the axis may miss it by round-off.
void require_zero(const casefile::Formula &along_x, const Vector3 &point, const char *what,
                  const casefile::TimeSteps &steps, int last) {
  for (int n = 0; n <= last; ++n)
    if (const double value = along_x.value({0, point[1], 0}, steps.at(n)); value != 0)
      throw CaseError(fmt::format(
          "{}: the {} along x is {:g} on the axis of the body, at y = {:g} m and t = {:g} s, where "
          "it can only be 0, as x is the radius; give 0, where there is a choice \"free\", or a "
          "formula that fades with x",
          along_x.where(), what, value, point[1], steps.at(n)));
}

}  // namespace

template <int dim>
void check_axis(const Discretisation<dim> &body, const casefile::Case &asked,
                const std::vector<Prescribed> &prescribed) {
  for (const casefile::BoundaryCase &boundary : asked.boundaries)
    for (const std::string &name : boundary.on)
      if (says_more_than_displacement_along_x(boundary) && lies_on_axis(body, name))
        refuse_on_axis(boundary.where, name);
  for (const casefile::ElectrodeCase &electrode : asked.electrodes)
    for (const std::string &name : electrode.on)
      if (lies_on_axis(body, name))
        refuse_on_axis(electrode.where, name);
  for (const casefile::ContactCase &contact : asked.contacts)
    for (const std::string &name : contact.on)
      if (lies_on_axis(body, name))
        refuse_on_axis(contact.where, name);
  const casefile::TimeSteps steps(asked.time);
  for (const Prescribed &p : prescribed)
    if (p.unknown % Fields<dim>::count == 0 &&
        body.is_on_axis(static_cast<Node>(p.unknown / Fields<dim>::count)))
      require_zero(p.value, p.point, "displacement", steps, steps.count());
  for (const auto &[start, what] : {std::pair{&asked.initial.displacement, "displacement"},
                                    std::pair{&asked.initial.velocity, "velocity"}})
    for (Node node = 0; !start->empty() && node < body.n_nodes(); ++node)
      if (body.is_on_axis(node))
        require_zero(start->front(), body.points()[node], what, steps, 0);
  for (const casefile::ContactCase &contact : asked.contacts)
    for (const Node node : body.nodes_on(contact.on))
      if (body.is_on_axis(node) && !contact.foundation_displacement.empty())
        require_zero(contact.foundation_displacement.front(), body.points()[node], "displacement",
                     steps, steps.count());
}

template <int dim>
std::vector<Prescribed> with_all(int component, const Discretisation<dim> &body,
                                 std::vector<Prescribed> prescribed) {
  std::vector<bool> mask = mask_of(prescribed, body.n_nodes() * Fields<dim>::count);
  for (Node node = 0; node < body.n_nodes(); ++node)
    if (const std::size_t i = unknown<dim>(node, component); !mask[i])
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
  if (initial.state)
    return *initial.state;
  std::vector<double> state(body.n_nodes() * Fields<dim>::count, 0.);
  parallel::together([&] {
    for (Node node = 0; node < body.n_nodes(); ++node) {
      const Vector3 &point = body.points()[node];
      for (int c = 0; c < dim && !initial.displacement.empty(); ++c)
        state[unknown<dim>(node, c)] = initial.displacement[c].value(point, 0);
      state[unknown<dim>(node, Fields<dim>::potential)] = initial.potential.value(point, 0);
      state[unknown<dim>(node, Fields<dim>::temperature)] = initial.temperature.value(point, 0);
    }
  });
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
template std::vector<Prescribed> with_all<2>(int, const Discretisation<2> &,
                                             std::vector<Prescribed>);
template std::vector<Prescribed> with_all<3>(int, const Discretisation<3> &,
                                             std::vector<Prescribed>);
template void check_axis<2>(const Discretisation<2> &, const casefile::Case &,
                            const std::vector<Prescribed> &);
template void check_axis<3>(const Discretisation<3> &, const casefile::Case &,
                            const std::vector<Prescribed> &);
template std::vector<Node> nodes_with_conditions(const Discretisation<2> &, const casefile::Case &);
template std::vector<Node> nodes_with_conditions(const Discretisation<3> &, const casefile::Case &);
template std::vector<std::vector<Node>> electrode_nodes<2>(
    const std::vector<Prescribed> &, const std::vector<casefile::ElectrodeCase> &);
template std::vector<std::vector<Node>> electrode_nodes<3>(
    const std::vector<Prescribed> &, const std::vector<casefile::ElectrodeCase> &);
template std::vector<double> initial_state<2>(const Discretisation<2> &,
                                              const casefile::InitialCase &);
template std::vector<double> initial_state<3>(const Discretisation<3> &,
                                              const casefile::InitialCase &);

}  // namespace tourmaline::body
