#include "body/regional_nodes.h"

#include <algorithm>
#include <limits>

#include "parallel/ranks.h"

namespace tourmaline::body {

template <int dim>
RegionalNodes::RegionalNodes(const Discretisation<dim> &body)
    : least_(body.n_nodes(), -std::numeric_limits<double>::infinity()) {
  std::vector<std::pair<Node, std::uint32_t>> pairs;
  body.for_each_cell_sampled([&](const Quadrature<dim> &cell) {
    regions_of_cells_.push_back(static_cast<std::uint32_t>(cell.region));
    for (const Node node : cell.nodes)
      least_[node] = std::max(least_[node], -static_cast<double>(cell.region));
    if (cell.region > 0)
      for (const Node node : cell.nodes)
        pairs.emplace_back(node, static_cast<std::uint32_t>(cell.region));
  });
  parallel::largest(least_);
  for (double &region : least_)
    region = -region;
  std::vector<std::uint32_t> plain;
  for (const auto &[node, region] : pairs)
    if (region != least_[node])
      plain.insert(plain.end(), {node, region});
  plain = parallel::joined(plain);
  for (std::size_t i = 0; i < plain.size(); i += 2)
    others_.emplace_back(plain[i], plain[i + 1]);
  std::sort(others_.begin(), others_.end());
  others_.erase(std::unique(others_.begin(), others_.end()), others_.end());
}

std::uint32_t RegionalNodes::number(Node node, std::size_t region) const {
  if (least_[node] == static_cast<double>(region))
    return node;
  const auto found = std::lower_bound(others_.begin(), others_.end(),
                                      std::pair{node, static_cast<std::uint32_t>(region)});
  return static_cast<std::uint32_t>(least_.size() + (found - others_.begin()));
}

template RegionalNodes::RegionalNodes(const Discretisation<2> &);
template RegionalNodes::RegionalNodes(const Discretisation<3> &);

}  // namespace tourmaline::body
