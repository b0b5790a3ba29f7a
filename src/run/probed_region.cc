#include "run/probed_region.h"

#include <algorithm>

#include "parallel/ranks.h"

namespace tourmaline::run {

using body::Fields;

template <int dim>
ProbedRegion<dim>::ProbedRegion(const body::Discretisation<dim> &body,
                                const casefile::ModelCase &model, std::vector<std::size_t> regions)
    : regions_(std::move(regions)) {
  for (int c = 0; c < Fields<dim>::count; ++c)
    if (model.has(body::column_of<dim>(c)))
      components_.push_back(c);
  std::vector<double> weights(body.n_nodes(), 0.);
  std::vector<body::Node> nodes;
  parallel::together([&] {
    body.for_each_cell([&](const body::Quadrature<dim> &cell) {
      if (!has(cell.region))
        return;
      nodes.insert(nodes.end(), cell.nodes.begin(), cell.nodes.end());
      for (std::size_t q = 0; q < cell.jxw.size(); ++q)
        for (std::size_t a = 0; a < cell.nodes.size(); ++a)
          weights[cell.nodes[a]] += cell.jxw[q] * cell.value(q, a);
    });
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  });
  nodes_ = parallel::joined(nodes);
  std::sort(nodes_.begin(), nodes_.end());
  nodes_.erase(std::unique(nodes_.begin(), nodes_.end()), nodes_.end());
  parallel::sum(weights);
  for (const body::Node node : nodes_) {
    weights_.push_back(weights[node]);
    volume_ += weights[node];
  }
}

template <int dim>
bool ProbedRegion<dim>::has(std::size_t region) const {
  return std::find(regions_.begin(), regions_.end(), region) != regions_.end();
}

template <int dim>
typename ProbedRegion<dim>::Columns ProbedRegion<dim>::columns(
    std::span<const double> state, const std::vector<body::Energies> &stored) const {
  body::Energies sum;
  for (const std::size_t region : regions_) {
    sum.elastic += stored[region].elastic;
    sum.electric += stored[region].electric;
    sum.thermal += stored[region].thermal;
    sum.coupling += stored[region].coupling;
  }
  Columns columns{{"volume", volume_},
                  {"elastic_energy", sum.elastic},
                  {"electric_energy", sum.electric},
                  {"thermal_energy", sum.thermal},
                  {"coupling_energy", sum.coupling}};
  add_fields(state, columns);
  return columns;
}

template <int dim>
void ProbedRegion<dim>::add_fields(std::span<const double> state, Columns &columns) const {
  for (const int c : components_) {
    const std::string name = body::column_of<dim>(c);
    double integral = 0, least = state[body::unknown<dim>(nodes_[0], c)], greatest = least;
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      const double value = state[body::unknown<dim>(nodes_[i], c)];
      integral += weights_[i] * value;
      least = std::min(least, value);
      greatest = std::max(greatest, value);
    }
    columns.insert(
        columns.end(),
        {{"mean_" + name, integral / volume_}, {"min_" + name, least}, {"max_" + name, greatest}});
  }
}

template class ProbedRegion<2>;
template class ProbedRegion<3>;

}  // namespace tourmaline::run
