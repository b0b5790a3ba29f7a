#include "solve/exchange_weights.h"

#include "parallel/ranks.h"

namespace tourmaline::solve {

template <int dim>
std::vector<std::pair<body::Node, double>> exchange_weights(
    const body::Discretisation<dim> &body, const std::vector<std::string> &boundaries,
    const casefile::Formula &coefficient, double factor) {
  std::vector<double> by_node(body.n_nodes(), 0.);
  body.for_each_facet(boundaries, [&](const body::Quadrature<dim> &facet) {
    for (std::size_t q = 0; q < facet.jxw.size(); ++q)
      for (std::size_t a = 0; a < facet.nodes.size(); ++a)
        by_node[facet.nodes[a]] +=
            factor * coefficient.value(facet.points[q], 0) * facet.jxw[q] * facet.value(q, a);
  });
  body.sharing().add_up(by_node);
  std::vector<std::pair<body::Node, double>> weights;
  for (const body::Node node : body.nodes_on(boundaries))
    weights.emplace_back(node, by_node[node]);
  return weights;
}

template std::vector<std::pair<body::Node, double>> exchange_weights(
    const body::Discretisation<2> &, const std::vector<std::string> &, const casefile::Formula &,
    double);
template std::vector<std::pair<body::Node, double>> exchange_weights(
    const body::Discretisation<3> &, const std::vector<std::string> &, const casefile::Formula &,
    double);

}  // namespace tourmaline::solve
