#include "solve/exchange_nodes.h"

#include <fmt/format.h>

#include <algorithm>

#include "larger.h"
#include "solve/circuit.h"
#include "tourmaline/error.h"

namespace tourmaline::solve {

using body::Fields;
using contact::Crossing;
using Eigen::Index;
using Eigen::VectorXd;

namespace {

constexpr Crossing all_crossings[] = {Crossing::heat, Crossing::charge};

template <int dim>
constexpr int component_of(Crossing what) {
  return what == Crossing::heat ? Fields<dim>::temperature : Fields<dim>::potential;
}

template <int dim>
std::vector<ExchangeSite> sites_where(bool prescribed, const Model<dim> &model) {
  std::vector<ExchangeSite> sites;
  const std::vector<bool> is_prescribed = body::mask_of(model.prescribed, model.n_unknowns());
  for (const Crossing what : all_crossings)
    for (std::size_t i = 0; i < model.interface.size(); ++i) {
      const contact::InterfaceNode<dim> &at = model.interface[i];
      const std::size_t unknown = body::unknown<dim>(at.node, component_of<dim>(what));
      if (is_prescribed[unknown] == prescribed && model.laws.of(at).crosses_by_state(what))
        sites.push_back({i, what, unknown});
    }
  return sites;
}

// Where an electrode says what the potential is, what crosses is its support's charge; where it
// does not, the circuit would have to know of that charge.
template <int dim>
void require_given_voltages(const Model<dim> &model, const std::vector<ExchangeSite> &held) {
  const Circuit circuit(model.asked.electrodes, model.step);
  for (const ExchangeSite &site : held)
    for (const std::size_t e : circuit.free()) {
      const contact::InterfaceNode<dim> &at = model.interface[site.node];
      const std::vector<body::Node> &nodes = model.electrodes[e];
      if (site.what == Crossing::charge &&
          std::find(nodes.begin(), nodes.end(), at.node) != nodes.end())
        throw CaseError(fmt::format(
            "[contact] electric: at ({:g}, {:g}, {:g}) the contact touches electrode \"{}\", whose "
            "voltage is not given; charge that crosses by the contact's state is not available "
            "there: leave out its ramp, or leave a facet between the two",
            at.point[0], at.point[1], at.point[2], model.asked.electrodes[e].name));
    }
}

}  // namespace

template <int dim>
std::vector<ExchangeSite> exchange_sites(const Model<dim> &model) {
  return sites_where(false, model);
}

template <int dim>
contact::Exchange::Value charge_exchange_at_start(const Model<dim> &model,
                                                  const contact::InterfaceNode<dim> &at,
                                                  std::span<const double> state) {
  contact::ContactState contact;
  contact.penetration = -model.reach(at, 0);
  for (int c = 0; c < dim; ++c)
    contact.penetration += at.normal[c] * state[body::unknown<dim>(at.node, c)];
  return model.laws.of(at)
      .exchange(Crossing::charge, at.point, 0, 0)
      ->at(state[body::unknown<dim>(at.node, Fields<dim>::potential)], contact);
}

std::vector<std::size_t> unknowns_of(const std::vector<ExchangeSite> &sites) {
  std::vector<std::size_t> unknowns;
  for (const ExchangeSite &site : sites)
    unknowns.push_back(site.unknown);
  return unknowns;
}

template <int dim>
std::vector<std::size_t> contact_unknowns(const Model<dim> &model,
                                          const std::vector<ExchangeSite> &sites) {
  std::vector<std::size_t> unknowns;
  for (const contact::InterfaceNode<dim> &at : model.interface)
    for (int c = 0; c < dim; ++c)
      unknowns.push_back(body::unknown<dim>(at.node, c));
  const std::vector<std::size_t> exchanged = unknowns_of(sites);
  unknowns.insert(unknowns.end(), exchanged.begin(), exchanged.end());
  return unknowns;
}

// Entries in which the field's block of the operator is of the size of that of u.
template <int dim>
ExchangeNodes<dim>::ExchangeNodes(const Model<dim> &model)
    : model_(model), sites_(exchange_sites(model)), held_(sites_where(true, model)) {
  require_given_voltages(model, held_);
  scale_.resize(size());
  crossed_ = crossed_before_ = VectorXd::Zero(size() + static_cast<Index>(held_.size()));
  if (sites_.empty())
    return;
  const auto scales = model.op.scales(model.step);
  for (std::size_t k = 0; k < sites_.size(); ++k)
    scale_[static_cast<Index>(k)] =
        scales[static_cast<std::size_t>(component_of<dim>(sites_[k].what))] / scales[0];
}

template <int dim>
VectorXd ExchangeNodes<dim>::entries(std::span<const double> state) const {
  VectorXd entries(size());
  for (std::size_t k = 0; k < sites_.size(); ++k)
    entries[static_cast<Index>(k)] = state[sites_[k].unknown] / scale_[static_cast<Index>(k)];
  return entries;
}

// The heat rows are scaled by -k / theta_ref, the electric rows by -1: what leaves the body stands
// on their right side with a plus.
template <int dim>
double ExchangeNodes<dim>::of_flow(std::size_t k) const {
  const double weight = model_.interface[sites_[k].node].weight;
  return sites_[k].what == Crossing::heat ? model_.step / model_.op.reference_temperature() * weight
                                          : weight;
}

// `crossed`: its place in `crossed_`.
template <int dim>
typename ExchangeNodes<dim>::Law ExchangeNodes<dim>::law(const ExchangeSite &site, Index crossed,
                                                         double time) const {
  const contact::InterfaceNode<dim> &at = model_.interface[site.node];
  return model_.laws.of(at).exchange(site.what, at.point, time, crossed_[crossed]);
}

template <int dim>
void ExchangeNodes<dim>::begin_step(double time, std::span<const double> state) {
  laws_.clear();
  for (std::size_t k = 0; k < sites_.size(); ++k)
    laws_.push_back(law(sites_[k], static_cast<Index>(k), time));
  held_laws_.clear();
  held_values_.clear();
  for (std::size_t k = 0; k < held_.size(); ++k) {
    held_laws_.push_back(law(held_[k], size() + static_cast<Index>(k), time));
    held_values_.push_back(state[held_[k].unknown]);
  }
}

template <int dim>
std::vector<ExchangePoint> ExchangeNodes<dim>::points(const ContactNodes<dim> &contact) const {
  std::vector<ExchangePoint> points;
  for (std::size_t k = 0; k < sites_.size(); ++k) {
    const auto entry = static_cast<Index>(k);
    ExchangePoint &point = points.emplace_back(contact.seen_by_exchange(sites_[k].node));
    point.law = laws_[k];
    point.entry = contact.n_unknowns() + entry;
    point.field = sites_[k].what == sites_[0].what ? 0 : 1;
    point.of_value = scale_[entry];
    point.of_flow = scale_[entry] * of_flow(k);
  }
  return points;
}

template <int dim>
std::vector<FieldRows> ExchangeNodes<dim>::fields(Index first, const VectorXd &terms) const {
  std::vector<FieldRows> fields;
  for (std::size_t k = 0; k < sites_.size(); ++k) {
    const auto entry = static_cast<Index>(k);
    if (k == 0 || sites_[k].what != sites_[k - 1].what)
      fields.push_back({first + entry, 0, 0});
    FieldRows &rows = fields.back();
    rows.scale = larger(rows.scale, terms[entry]);
    ++rows.size;
  }
  return fields;
}

// By the law's slope at the value at hand: exact where the law is linear in it.
template <int dim>
typename ExchangeNodes<dim>::Row ExchangeNodes<dim>::row(std::size_t site, double value,
                                                         const contact::ContactState &state) const {
  const contact::Exchange::Value q = laws_[site]->at(value, state);
  const double weight = of_flow(site);
  return {weight * q.by_value, weight * (q.flow - q.by_value * value)};
}

template <int dim>
void ExchangeNodes<dim>::prepare(StepOutcome &outcome) const {
  const VectorXd zero = VectorXd::Zero(static_cast<Index>(model_.interface.size()));
  if (model_.laws.crosses_by_state(Crossing::heat))
    outcome.heat_flow = zero;
  if (model_.laws.is_warmed_by_friction())
    outcome.friction_heat = zero;
  if (model_.laws.crosses_by_state(Crossing::charge))
    outcome.charge_flow = zero;
}

template <int dim>
void ExchangeNodes<dim>::cross(const ExchangeSite &site, Index crossed,
                               const contact::Exchange::Value &q, double friction,
                               StepOutcome &outcome) {
  const auto node = static_cast<Index>(site.node);
  const double weight = model_.interface[site.node].weight;
  if (site.what == Crossing::charge) {
    outcome.charge_flow[node] = weight * q.flow;
    crossed_[crossed] = q.flow;
    return;
  }
  outcome.heat_flow[node] = weight * q.flow;
  if (q.by_friction != 0)
    outcome.friction_heat[node] = -weight * q.by_friction * friction;
}

template <int dim>
void ExchangeNodes<dim>::end_step(const VectorXd &values, const StateAtNode &state_at,
                                  StepOutcome &outcome) {
  crossed_before_ = crossed_;
  const auto end = [&](const ExchangeSite &site, const contact::Exchange &law, Index crossed,
                       double value) {
    const contact::ContactState state = state_at(site.node);
    cross(site, crossed, law.at(value, state), state.friction, outcome);
  };
  for (std::size_t k = 0; k < sites_.size(); ++k)
    end(sites_[k], *laws_[k], static_cast<Index>(k), values[static_cast<Index>(k)]);
  for (std::size_t k = 0; k < held_.size(); ++k)
    end(held_[k], *held_laws_[k], size() + static_cast<Index>(k), held_values_[k]);
}

template <int dim>
VectorXd ExchangeNodes<dim>::rows(const StepOutcome &outcome) const {
  VectorXd rows(size());
  for (std::size_t k = 0; k < sites_.size(); ++k) {
    const auto node = static_cast<Index>(sites_[k].node);
    const VectorXd &flow =
        sites_[k].what == Crossing::heat ? outcome.heat_flow : outcome.charge_flow;
    rows[static_cast<Index>(k)] = of_flow(k) * flow[node] / model_.interface[sites_[k].node].weight;
  }
  return rows;
}

template <int dim>
void ExchangeNodes<dim>::save(output::SavedNumbers &numbers) const {
  if (model_.laws.remembers_charge())
    numbers.put("charge that has crossed", crossed_);
}

template <int dim>
void ExchangeNodes<dim>::restore(const output::SavedNumbers &numbers) {
  if (model_.laws.remembers_charge())
    numbers.fill("charge that has crossed", crossed_);
}

template std::vector<ExchangeSite> exchange_sites<2>(const Model<2> &);
template std::vector<ExchangeSite> exchange_sites<3>(const Model<3> &);
template contact::Exchange::Value charge_exchange_at_start(const Model<2> &,
                                                           const contact::InterfaceNode<2> &,
                                                           std::span<const double>);
template contact::Exchange::Value charge_exchange_at_start(const Model<3> &,
                                                           const contact::InterfaceNode<3> &,
                                                           std::span<const double>);
template std::vector<std::size_t> contact_unknowns<2>(const Model<2> &,
                                                      const std::vector<ExchangeSite> &);
template std::vector<std::size_t> contact_unknowns<3>(const Model<3> &,
                                                      const std::vector<ExchangeSite> &);
template class ExchangeNodes<2>;
template class ExchangeNodes<3>;

}  // namespace tourmaline::solve
