#include "solve/leaked_charge.h"

#include <algorithm>

#include "parallel/ranks.h"

namespace tourmaline::solve {

using body::Fields;
using body::unknown;
using Eigen::Index;
using Eigen::VectorXd;

namespace {

template <int dim>
void add_facets(const Model<dim> &model, const body::SurfaceExchange &leak,
                std::optional<double> time, std::span<const double> state,
                std::vector<double> &by_node) {
  model.body.for_each_facet(leak.on, [&](const body::Quadrature<dim> &facet) {
    for (std::size_t q = 0; q < facet.jxw.size(); ++q) {
      double higher = time ? -leak.outside.value(facet.points[q], *time) : 0;
      for (std::size_t a = 0; a < facet.nodes.size(); ++a)
        higher += facet.value(q, a) * state[unknown<dim>(facet.nodes[a], Fields<dim>::potential)];
      const double flow =
          model.step * leak.coefficient.value(facet.points[q], 0) * facet.jxw[q] * higher;
      for (std::size_t a = 0; a < facet.nodes.size(); ++a)
        by_node[facet.nodes[a]] += facet.value(q, a) * flow;
    }
  });
}

}  // namespace

template <int dim>
std::vector<double> leaking(const Model<dim> &model, std::optional<double> time,
                            std::span<const double> state) {
  std::vector<double> by_node(model.body.n_nodes(), 0.);
  parallel::together([&] {
    for (const body::SurfaceExchange &exchange : model.linear_exchanges)
      if (exchange.accumulates)
        add_facets(model, exchange, time, state, by_node);
  });
  model.sharing().add_up(by_node);
  return by_node;
}

template <int dim>
LeakedCharge<dim>::LeakedCharge(const Model<dim> &model)
    : model_(model),
      leaks_(std::any_of(model.linear_exchanges.begin(), model.linear_exchanges.end(),
                         [](const body::SurfaceExchange &at) { return at.accumulates; })) {
  if (leaks_)
    charge_ = flux_ = VectorXd::Zero(static_cast<Index>(model.interface.size()));
}

template <int dim>
void LeakedCharge<dim>::add_to(std::vector<double> &right_side) const {
  for (Index i = 0; i < charge_.size(); ++i)
    right_side[unknown<dim>(model_.interface[static_cast<std::size_t>(i)].node,
                            Fields<dim>::potential)] += charge_[i];
}

template <int dim>
void LeakedCharge<dim>::describe(StepOutcome &outcome) const {
  outcome.leaked_charge = charge_;
  outcome.leaked_flux = flux_;
}

template <int dim>
void LeakedCharge<dim>::end_step(double time, std::span<const double> state) {
  if (!leaks_)
    return;
  const std::vector<double> by_node = leaking(model_, time, state);
  for (std::size_t i = 0; i < model_.interface.size(); ++i) {
    const contact::InterfaceNode<dim> &at = model_.interface[i];
    charge_[static_cast<Index>(i)] += by_node[at.node];
    if (const auto leak = model_.laws.of(at).linear(contact::Crossing::charge);
        leak && leak->accumulates)
      flux_[static_cast<Index>(i)] += leak->factor * leak->coefficient.value(at.point, 0) *
                                      (state[unknown<dim>(at.node, Fields<dim>::potential)] -
                                       leak->outside.value(at.point, time));
  }
}

template <int dim>
void LeakedCharge<dim>::save(output::SavedNumbers &numbers) const {
  if (!leaks_)
    return;
  numbers.put("leaked charge", charge_);
  numbers.put("leaked flux", flux_);
}

template <int dim>
void LeakedCharge<dim>::restore(const output::SavedNumbers &numbers) {
  if (!leaks_)
    return;
  numbers.fill("leaked charge", charge_);
  numbers.fill("leaked flux", flux_);
}

template std::vector<double> leaking(const Model<2> &, std::optional<double>,
                                     std::span<const double>);
template std::vector<double> leaking(const Model<3> &, std::optional<double>,
                                     std::span<const double>);
template class LeakedCharge<2>;
template class LeakedCharge<3>;

}  // namespace tourmaline::solve
