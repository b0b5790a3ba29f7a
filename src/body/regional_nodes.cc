#include "body/regional_nodes.h"

#include <algorithm>

#include "parallel/ranks.h"

namespace tourmaline::body {

template <int dim>
RegionalNodes::RegionalNodes(const Discretisation<dim> &body)
    : sharing_(body.sharing()), least_(sharing_.n_nodes(), none) {
  double last = 0;
  body.for_each_cell_sampled([&](const Quadrature<dim> &cell) {
    regions_of_cells_.push_back(static_cast<std::uint32_t>(cell.region));
    last = std::max(last, static_cast<double>(cell.region));
  });
  parallel::largest({&last, 1});
  for (std::uint32_t region = 0; region <= static_cast<std::uint32_t>(last); ++region)
    add(region, nodes_in(body, region));
  std::sort(others_.begin(), others_.end());
  number_others();
}

// By node, of all ranks' cells; above 0: it is.
template <int dim>
std::vector<double> RegionalNodes::nodes_in(const Discretisation<dim> &body,
                                            std::uint32_t region) const {
  std::vector<double> is_there(sharing_.n_nodes(), 0.);
  std::size_t cell = 0;
  body.for_each_cell_nodes([&](std::span<const Node> nodes) {
    if (regions_of_cells_[cell++] == region)
      for (const Node node : nodes)
        is_there[node] = 1;
  });
  sharing_.add_up(is_there);
  return is_there;
}

void RegionalNodes::add(std::uint32_t region, const std::vector<double> &is_there) {
  for (Node node = 0; node < is_there.size(); ++node)
    if (is_there[node] > 0 && least_[node] == none)
      least_[node] = region;
    else if (is_there[node] > 0)
      others_.emplace_back(node, region);
}

// Each stands in the list of the rank that its node belongs to.
void RegionalNodes::number_others() {
  std::vector<std::uint32_t> plain;
  for (const auto &[node, region] : others_)
    if (sharing_.is_own(node))
      plain.insert(plain.end(), {sharing_.number(node), region});
  plain = parallel::joined(plain);
  std::vector<std::pair<Node, std::uint32_t>> all;
  for (std::size_t i = 0; i < plain.size(); i += 2)
    all.emplace_back(plain[i], plain[i + 1]);
  std::sort(all.begin(), all.end());
  size_of_whole_ = sharing_.n_all() + all.size();
  for (const auto &[node, region] : others_) {
    const auto found =
        std::lower_bound(all.begin(), all.end(), std::pair{sharing_.number(node), region});
    numbers_of_others_.push_back(
        static_cast<std::uint32_t>(sharing_.n_all() + (found - all.begin())));
  }
}

std::uint32_t RegionalNodes::number(Node node, std::size_t region) const {
  if (least_[node] == region)
    return node;
  const auto found = std::lower_bound(others_.begin(), others_.end(),
                                      std::pair{node, static_cast<std::uint32_t>(region)});
  return static_cast<std::uint32_t>(least_.size() + (found - others_.begin()));
}

std::uint32_t RegionalNodes::number_in_whole(std::size_t number) const {
  return number < least_.size() ? sharing_.number(static_cast<Node>(number))
                                : numbers_of_others_[number - least_.size()];
}

template RegionalNodes::RegionalNodes(const Discretisation<2> &);
template RegionalNodes::RegionalNodes(const Discretisation<3> &);

}  // namespace tourmaline::body
