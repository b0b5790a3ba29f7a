#include "body/loads.h"

#include <numeric>

#include "parallel/ranks.h"
#include "tourmaline/case/case.h"

namespace tourmaline::body {

Load::Load(LoadKind kind, casefile::Formula density, double factor, int stride, int component)
    : kind_(std::move(kind)),
      density_(std::move(density)),
      factor_(factor),
      stride_(stride),
      component_(component) {}

void Load::add(Share share) {
  if (density_.depends_on_place() && density_.depends_on_time()) {
    shares_.push_back(std::move(share));
    return;
  }
  // A density without t is integrated here and now, one without place up to its value in time.
  const double density = density_.depends_on_time() ? 1 : density_.value(share.point, 0);
  for (std::size_t a = 0; a < share.nodes.size(); ++a)
    if (share.weights[a] != 0 && density != 0) {
      if (uniform_.size() <= share.nodes[a])
        uniform_.resize(share.nodes[a] + std::size_t{1}, 0.);
      uniform_[share.nodes[a]] += factor_ * density * share.weights[a];
      sum_ += factor_ * density * share.weights[a];
    }
}

void Load::sum_over_ranks(const NodeSharing &sharing) {
  if (parallel::n_ranks() == 1)
    return;
  uniform_.resize(sharing.n_nodes(), 0.);
  sharing.add_up(uniform_);
  sum_ = parallel::sum(sum_);
}

bool Load::is_distributed() const {
  return parallel::n_ranks() > 1 && density_.depends_on_place() && density_.depends_on_time();
}

double Load::factor_in_time(double t) const {
  return density_.depends_on_time() && !density_.depends_on_place() ? density_.value({}, t) : 1;
}

void Load::integrate(double t, std::vector<double> &right_side) const {
  const double density = factor_in_time(t);
  for (std::size_t node = 0; node < uniform_.size(); ++node)
    right_side[node * stride_ + component_] += density * uniform_[node];
  for (const Share &share : shares_)
    add_to(right_side, density_.value(share.point, t), share);
}

double Load::resultant(double t) const {
  double sum = 0;
  for (const Share &share : shares_)
    sum += density_.value(share.point, t) *
           std::accumulate(share.weights.begin(), share.weights.end(), 0.);
  if (is_distributed())
    sum = parallel::sum(sum);
  return sum + factor_in_time(t) / factor_ * sum_;
}

void Load::add_to(std::vector<double> &right_side, double density, const Share &share) const {
  for (std::size_t a = 0; a < share.nodes.size(); ++a)
    right_side[std::size_t{share.nodes[a]} * stride_ + component_] +=
        factor_ * density * share.weights[a];
}

template <int dim>
void add_shares(const Quadrature<dim> &quadrature, const casefile::Formula &weight, Load &load) {
  for (std::size_t q = 0; q < quadrature.jxw.size(); ++q) {
    const double scale = quadrature.jxw[q] * weight.value(quadrature.points[q], 0);
    Load::Share share{quadrature.points[q], quadrature.nodes, {}};
    for (std::size_t a = 0; a < quadrature.nodes.size(); ++a)
      share.weights.push_back(scale * quadrature.value(q, a));
    load.add(std::move(share));
  }
}

template void add_shares<2>(const Quadrature<2> &, const casefile::Formula &, Load &);
template void add_shares<3>(const Quadrature<3> &, const casefile::Formula &, Load &);

template <int dim>
Loads<dim>::Loads(const Discretisation<dim> &body, const casefile::Case &asked, double step,
                  double reference_temperature, const std::vector<SurfaceExchange> &exchanges)
    : sharing_(&body.sharing()), heat_factor_(-step / reference_temperature) {
  add_volume_loads(body, asked.load);
  for (const casefile::BoundaryCase &boundary : asked.boundaries)
    add_surface_loads(body, boundary);
  for (const SurfaceExchange &exchange : exchanges)
    add_exchange(body, exchange);
}

template <int dim>
void Loads<dim>::add_volume_loads(const Discretisation<dim> &body, const casefile::LoadCase &load) {
  const auto over_cells = [&](LoadKind kind, const casefile::Formula &density, double factor,
                              int component) {
    if (density.is_zero())
      return;
    Load &added = loads_.emplace_back(kind, density, factor, Fields<dim>::count, component);
    parallel::together([&] {
      body.for_each_cell([&](const Quadrature<dim> &cell) { add_shares(cell, 1., added); });
    });
    added.sum_over_ranks(body.sharing());
  };
  for (int c = 0; c < static_cast<int>(load.force.size()); ++c)
    over_cells({LoadKind::force, "", c}, load.force[c], 1, c);
  over_cells({LoadKind::charge, ""}, load.charge, -1, Fields<dim>::potential);
  over_cells({LoadKind::heat, ""}, load.heat, heat_factor_, Fields<dim>::temperature);
}

template <int dim>
void Loads<dim>::add_over_facets(const Discretisation<dim> &body, LoadKind kind,
                                 const casefile::Formula &density, const casefile::Formula &weight,
                                 double factor, int component) {
  if (density.is_zero())
    return;
  const std::vector<std::string> boundary{kind.boundary};
  Load &added =
      loads_.emplace_back(std::move(kind), density, factor, Fields<dim>::count, component);
  parallel::together([&] {
    body.for_each_facet(boundary,
                        [&](const Quadrature<dim> &facet) { add_shares(facet, weight, added); });
  });
  added.sum_over_ranks(body.sharing());
}

template <int dim>
void Loads<dim>::add_surface_loads(const Discretisation<dim> &body,
                                   const casefile::BoundaryCase &boundary) {
  for (const std::string &name : boundary.on) {
    for (int c = 0; boundary.traction && c < dim; ++c)
      add_over_facets(body, {LoadKind::traction, name, c}, (*boundary.traction)[c], 1., 1, c);
    if (boundary.surface_charge)
      add_over_facets(body, {LoadKind::surface_charge, name}, *boundary.surface_charge, 1., 1,
                      Fields<dim>::potential);
    if (boundary.heat_flux)  // leaves the body, so it takes from the heat rows
      add_over_facets(body, {LoadKind::heat_flux, name}, *boundary.heat_flux, 1., -heat_factor_,
                      Fields<dim>::temperature);
  }
}

template <int dim>
void Loads<dim>::add_exchange(const Discretisation<dim> &body, const SurfaceExchange &exchange) {
  const bool is_heat = exchange.field == SurfaceExchange::temperature;
  for (const std::string &name : exchange.on)
    add_over_facets(body, {is_heat ? LoadKind::foundation_heat : LoadKind::foundation_charge, name},
                    exchange.outside, exchange.coefficient,
                    is_heat ? heat_factor_ : -exchange.factor,
                    is_heat ? Fields<dim>::temperature : Fields<dim>::potential);
}

template <int dim>
void Loads<dim>::integrate(double t, std::vector<double> &right_side) const {
  std::vector<double> share;  // of the distributed loads, this rank's
  parallel::together([&] {
    for (const Load &load : loads_) {
      if (load.is_distributed())
        share.resize(right_side.size(), 0.);
      load.integrate(t, load.is_distributed() ? share : right_side);
    }
  });
  if (!share.empty())
    sharing_->add_up(share);
  for (std::size_t i = 0; i < share.size(); ++i)
    right_side[i] += share[i];
}

template class Loads<2>;
template class Loads<3>;

}  // namespace tourmaline::body
