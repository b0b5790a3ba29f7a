#include "run/probed_region.h"

#include <algorithm>
#include <array>
#include <limits>

#include "parallel/ranks.h"

namespace tourmaline::run {

using body::Fields;

template <int dim>
ProbedRegion<dim>::ProbedRegion(const body::Discretisation<dim> &body,
                                const casefile::ModelCase &model, std::vector<std::size_t> regions)
    : sharing_(body.sharing()), regions_(std::move(regions)) {
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
  nodes = parallel::joined(sharing_.numbers(nodes));
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  nodes_ = sharing_.nodes(nodes);
  std::erase_if(nodes_, [&](body::Node node) { return !sharing_.counts(node); });
  sharing_.add_up(weights);
  for (const body::Node node : nodes_) {
    weights_.push_back(weights[node]);
    volume_ += weights[node];
  }
  volume_ = sharing_.sum(volume_);
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
    double integral = 0;
    std::array<double, 2> extremes;  // the least with a minus, the greatest
    extremes.fill(-std::numeric_limits<double>::infinity());
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      const double value = state[body::unknown<dim>(nodes_[i], c)];
      integral += weights_[i] * value;
      extremes = {std::max(extremes[0], -value), std::max(extremes[1], value)};
    }
    sharing_.largest(extremes);
    columns.insert(columns.end(), {{"mean_" + name, sharing_.sum(integral) / volume_},
                                   {"min_" + name, -extremes[0]},
                                   {"max_" + name, extremes[1]}});
  }
}

template class ProbedRegion<2>;
template class ProbedRegion<3>;

}  // namespace tourmaline::run
