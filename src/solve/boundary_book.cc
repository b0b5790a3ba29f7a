#include "solve/boundary_book.h"

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

#include "solve/exchange_weights.h"

namespace tourmaline::solve {

using body::Fields;
using body::LoadKind;

namespace {

void add_once(std::vector<std::string> &names, const std::string &name) {
  if (std::find(names.begin(), names.end(), name) == names.end())
    names.push_back(name);
}

// In the order of the first nodes whose temperatures they prescribe, whoever has these.
template <int dim>
std::vector<std::string> boundaries_with_temperatures(const Model<dim> &model) {
  constexpr double nowhere = std::numeric_limits<double>::infinity();
  std::map<std::string, double> first;
  for (const casefile::BoundaryCase &boundary : model.asked.boundaries)
    for (const std::string &name : boundary.on)
      first[name] = nowhere;
  for (const body::Prescribed &p : model.prescribed)
    if (p.unknown % Fields<dim>::count == Fields<dim>::temperature && p.is_given()) {
      const auto node = static_cast<body::Node>(p.unknown / Fields<dim>::count);
      first[p.boundary] = std::min<double>(first[p.boundary], model.sharing().number(node));
    }
  std::vector<std::pair<double, std::string>> ordered;
  for (const auto &[name, node] : first)
    if (const double of_all = -model.sharing().largest(-node); of_all < nowhere)
      ordered.emplace_back(of_all, name);
  std::sort(ordered.begin(), ordered.end());
  std::vector<std::string> names;
  for (auto &[node, name] : ordered)
    names.push_back(std::move(name));
  return names;
}

}  // namespace

template <int dim>
BoundaryBook<dim>::BoundaryBook(const Model<dim> &model)
    : model_(model),
      of_heat_(model.interface.size()),
      of_charge_(model.interface.size()),
      of_force_(model.interface.size()) {
  find_boundaries();
  weigh();
  for (const contact::Crossing what : {contact::Crossing::heat, contact::Crossing::charge})
    find_crossings(what);
  find_forces();
}

template <int dim>
void BoundaryBook<dim>::find_boundaries() {
  heats_ = boundaries_with_temperatures(model_);
  for (const body::Prescribed &p : model_.prescribed)
    if (p.unknown % Fields<dim>::count == Fields<dim>::potential && p.electrode < 0 && p.is_given())
      add_once(charges_, p.boundary);
  for (const body::Load &load : model_.loads.each())
    if (load.kind().kind == LoadKind::heat_flux)
      add_once(heats_, load.kind().boundary);
    else if (load.kind().kind == LoadKind::surface_charge)
      add_once(charges_, load.kind().boundary);
  for (const body::SurfaceExchange &linear : model_.linear_exchanges)
    for (const std::string &name : linear.on)
      add_once(linear.field == body::SurfaceExchange::temperature ? heats_ : charges_, name);
}

template <int dim>
void BoundaryBook<dim>::weigh() {
  for (const body::SurfaceExchange &linear : model_.linear_exchanges)
    for (const std::string &name : linear.on)
      (linear.field == body::SurfaceExchange::temperature ? exchange_ : capacitors_)[name] =
          exchange_weights(model_.body, {name}, linear.coefficient, linear.factor);
}

// What leaks by place alone leaks through facets, which reach nodes of other contacts.
template <int dim>
void BoundaryBook<dim>::find_crossings(contact::Crossing what) {
  const bool is_heat = what == contact::Crossing::heat;
  std::vector<std::string> &boundary_of = is_heat ? of_heat_ : of_charge_;
  const auto is_booked = [&](const contact::ContactLaws &laws) {
    return laws.crosses_by_state(what) || (!is_heat && laws.remembers_charge());
  };
  for (std::size_t c = 0; c < model_.asked.contacts.size(); ++c) {
    if (!is_booked(model_.laws[c]))
      continue;
    for (const std::string &name : model_.asked.contacts[c].on) {
      add_once(is_heat ? heats_ : charges_, name);
      const std::vector<body::Node> nodes = model_.body.nodes_on({name});
      for (std::size_t i = 0; i < boundary_of.size(); ++i)
        if ((model_.interface[i].contact == c || !model_.laws[c].crosses_by_state(what)) &&
            boundary_of[i].empty() &&
            std::binary_search(nodes.begin(), nodes.end(), model_.interface[i].node))
          boundary_of[i] = name;
    }
  }
}

template <int dim>
void BoundaryBook<dim>::find_forces() {
  for (std::size_t c = 0; c < model_.asked.contacts.size(); ++c)
    for (const std::string &name : model_.asked.contacts[c].on) {
      const std::vector<body::Node> nodes = model_.body.nodes_on({name});
      for (std::size_t i = 0; i < of_force_.size(); ++i)
        if (model_.interface[i].contact == c && of_force_[i].empty() &&
            std::binary_search(nodes.begin(), nodes.end(), model_.interface[i].node))
          of_force_[i] = name;
    }
}

template <int dim>
double BoundaryBook<dim>::sum(const Weights &weights, int component, const std::string &boundary,
                              std::span<const double> state) {
  double flow = 0;
  if (const auto found = weights.find(boundary); found != weights.end())
    for (const auto &[node, weight] : found->second)
      flow += weight * state[body::unknown<dim>(node, component)];
  return flow;
}

template <int dim>
double BoundaryBook<dim>::heat_exchanged(const std::string &boundary,
                                         std::span<const double> state) const {
  return sum(exchange_, Fields<dim>::temperature, boundary, state);
}

template <int dim>
double BoundaryBook<dim>::charge_held(const std::string &boundary,
                                      std::span<const double> state) const {
  return sum(capacitors_, Fields<dim>::potential, boundary, state);
}

template class BoundaryBook<2>;
template class BoundaryBook<3>;

}  // namespace tourmaline::solve
