#include "solve/boundary_flow.h"

#include <cmath>
#include <numeric>
#include <set>
#include <utility>

#include "parallel/ranks.h"

namespace tourmaline::solve {

using body::Fields;
using body::Load;
using body::LoadKind;
using body::Quadrature;
using body::SurfaceExchange;

namespace {

// Every boundary with a condition or a contact.
std::set<std::string> boundaries_that_hold(const casefile::Case &asked) {
  std::set<std::string> names;
  for (const casefile::BoundaryCase &boundary : asked.boundaries)
    names.insert(boundary.on.begin(), boundary.on.end());
  for (const casefile::ContactCase &contact : asked.contacts)
    names.insert(contact.on.begin(), contact.on.end());
  return names;
}

template <int dim>
double area_of(const Quadrature<dim> &facet) {
  return std::accumulate(facet.jxw.begin(), facet.jxw.end(), 0.);
}

// Adds the facet's area to its nodes; those of its cell that are not on it have no shape function
// there.
template <int dim>
void add_area(const Quadrature<dim> &facet, std::vector<double> &areas) {
  constexpr double none = 1e-9;
  for (std::size_t a = 0; a < facet.nodes.size(); ++a) {
    double size = 0;
    for (std::size_t q = 0; q < facet.jxw.size(); ++q)
      size += std::abs(facet.value(q, a));
    if (size > none)
      areas[facet.nodes[a]] += area_of(facet);
  }
}

void add_force(const Eigen::Vector3d &force, const Vector3 &place, const Vector3 &about,
               BoundaryFlow &flow) {
  flow.force += force;
  flow.moment += (Eigen::Vector3d(place.data()) - Eigen::Vector3d(about.data())).cross(force);
}

}  // namespace

template <int dim>
BoundaryPart<dim>::BoundaryPart(const Model<dim> &model, std::vector<std::string> names)
    : model_(model), names_(std::move(names)) {
  parallel::together([&] {
    model.body.for_each_facet(names_,
                              [&](const Quadrature<dim> &facet) { area_ += area_of(facet); });
  });
  area_ = parallel::sum(area_);
  for (const casefile::BoundaryCase &boundary : model.asked.boundaries)
    add_loads(boundary);
  for (std::size_t i = 0; i < model.linear_exchanges.size(); ++i)
    add_exchange(i);
  find_shares();
}

template <int dim>
void BoundaryPart<dim>::find_shares() {
  for (const std::string &boundary : boundaries_that_hold(model_.asked))
    of_boundaries_[boundary] = shares_of({boundary});
  // The charge of an electrode inside leaves through no boundary.
  for (const casefile::ElectrodeCase &electrode : model_.asked.electrodes) {
    std::vector<std::string> outer = electrode.on;
    std::erase_if(outer, [&](const std::string &name) { return !model_.body.is_boundary(name); });
    of_electrodes_[electrode.name] = shares_of(outer);
  }
}

template <int dim>
void BoundaryPart<dim>::add_loads(const casefile::BoundaryCase &boundary) {
  const auto add = [&](const std::string &name, const casefile::Formula &density, int component,
                       std::vector<Load> &loads) {
    if (!density.is_zero())
      loads.push_back(over_facets(name, density, 1., component));
  };
  for (const std::string &name : boundary.on) {
    for (int c = 0; boundary.traction && c < dim; ++c)
      add(name, (*boundary.traction)[c], c, tractions_);
    if (boundary.surface_charge)
      add(name, *boundary.surface_charge, Fields<dim>::potential, charges_);
    if (boundary.heat_flux)
      add(name, *boundary.heat_flux, Fields<dim>::temperature, heats_);
  }
}

// Over the facets of this part that have that name, too. The kind of the load is not asked for.
template <int dim>
Load BoundaryPart<dim>::over_facets(const std::string &name, const casefile::Formula &density,
                                    const casefile::Formula &weight, int component) const {
  Load load({LoadKind::traction, name, component}, density, 1, Fields<dim>::count, component);
  parallel::together([&] {
    model_.body.for_each_facet_on_both({name}, names_, [&](const Quadrature<dim> &facet) {
      body::add_shares(facet, weight, load);
    });
  });
  load.sum_over_ranks(model_.sharing());
  return load;
}

template <int dim>
void BoundaryPart<dim>::add_exchange(std::size_t number) {
  const SurfaceExchange &linear = model_.linear_exchanges[number];
  const int component = linear.field == SurfaceExchange::temperature ? Fields<dim>::temperature
                                                                     : Fields<dim>::potential;
  for (const std::string &name : linear.on) {
    std::vector<double> weights(model_.n_unknowns(), 0.);
    over_facets(name, linear.coefficient, 1., component).integrate(0, weights);
    exchanges_.push_back({number, std::move(weights),
                          over_facets(name, linear.outside, linear.coefficient, component)});
  }
}

template <int dim>
typename BoundaryPart<dim>::Shares BoundaryPart<dim>::shares_of(
    const std::vector<std::string> &boundaries) const {
  std::vector<double> whole(model_.body.n_nodes(), 0.), here = whole;
  parallel::together([&] {
    model_.body.for_each_facet(boundaries,
                               [&](const Quadrature<dim> &facet) { add_area(facet, whole); });
    model_.body.for_each_facet_on_both(
        boundaries, names_, [&](const Quadrature<dim> &facet) { add_area(facet, here); });
  });
  model_.sharing().add_up(whole);
  model_.sharing().add_up(here);
  Shares shares;
  for (body::Node node = 0; node < here.size(); ++node)
    if (here[node] > 0)
      shares[node] = here[node] / whole[node];
  return shares;
}

template <int dim>
double BoundaryPart<dim>::share(const Passage &passage) const {
  const auto &all = passage.is_on_electrode ? of_electrodes_ : of_boundaries_;
  const auto holder = all.find(passage.boundary);
  if (holder == all.end())
    return 0;
  const auto found = holder->second.find(passage.node);
  return found == holder->second.end() ? 0 : found->second;
}

// By unknown, of all ranks [N].
template <int dim>
std::vector<double> BoundaryPart<dim>::tractions(double time) const {
  std::vector<double> forces, of_this_rank;
  parallel::together([&] {
    for (const Load &load : tractions_) {
      std::vector<double> &sum = load.is_distributed() ? of_this_rank : forces;
      sum.resize(model_.n_unknowns(), 0.);
      load.integrate(time, sum);
    }
  });
  if (!of_this_rank.empty())
    model_.sharing().add_up(of_this_rank);
  forces.resize(of_this_rank.empty() ? forces.size() : of_this_rank.size(), 0.);
  for (std::size_t i = 0; i < of_this_rank.size(); ++i)
    forces[i] += of_this_rank[i];
  return forces;
}

// What leaves the body: k_c (theta - theta_f), integrated.
template <int dim>
double BoundaryPart<dim>::exchanged(const Exchange &exchange, double time,
                                    std::span<const double> state) const {
  double inside = 0;
  for (std::size_t i = 0; i < state.size(); ++i)
    if (model_.counts(i))
      inside += state[i] * exchange.weights[i];
  return model_.linear_exchanges[exchange.number].factor *
         (model_.sharing().sum(inside) - exchange.outside.resultant(time));
}

// Charges and heats that do not pass at nodes.
template <int dim>
void BoundaryPart<dim>::add_given(double time, std::span<const double> state,
                                  BoundaryFlow &flow) const {
  for (const Load &load : charges_)
    flow.charge += load.resultant(time);
  for (const Load &load : heats_)
    flow.heat += load.resultant(time);
  for (const Exchange &exchange : exchanges_) {
    const bool is_heat =
        model_.linear_exchanges[exchange.number].field == SurfaceExchange::temperature;
    (is_heat ? flow.heat : flow.charge) += exchanged(exchange, time, state);
  }
}

// What passes at nodes, and what tractions do there.
template <int dim>
BoundaryFlow BoundaryPart<dim>::at_nodes(double time, std::span<const Passage> passages,
                                         const Vector3 &about) const {
  BoundaryFlow flow;
  const auto push = [&](body::Node node, int component, double size) {
    add_force(size * Eigen::Vector3d::Unit(component), model_.body.points()[node], about, flow);
  };
  for (const Passage &passage : passages) {
    if (!model_.sharing().counts(passage.node))
      continue;
    const double amount = share(passage) * passage.amount;
    if (passage.component < dim)
      push(passage.node, passage.component, amount);
    else
      (passage.component == Fields<dim>::potential ? flow.charge : flow.heat) += amount;
  }
  const std::vector<double> tractions = this->tractions(time);
  for (std::size_t i = 0; i < tractions.size(); ++i)
    if (tractions[i] != 0 && model_.counts(i))
      push(static_cast<body::Node>(i / Fields<dim>::count),
           static_cast<int>(i % Fields<dim>::count), tractions[i]);
  for (Eigen::Vector3d *sum : {&flow.force, &flow.moment})
    model_.sharing().sum(std::span(sum->data(), 3));
  for (double *sum : {&flow.charge, &flow.heat})
    *sum = model_.sharing().sum(*sum);
  return flow;
}

template <int dim>
BoundaryFlow BoundaryPart<dim>::flow(double time, std::span<const Passage> passages,
                                     std::span<const double> state, const Vector3 &about) const {
  BoundaryFlow flow = at_nodes(time, passages, about);
  add_given(time, state, flow);
  return flow;
}

template class BoundaryPart<2>;
template class BoundaryPart<3>;

}  // namespace tourmaline::solve
