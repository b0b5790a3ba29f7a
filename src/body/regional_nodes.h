#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "body/discretisation.h"

namespace tourmaline::body {

/// A body's nodes by region: where regions meet, a node is there once for each of them, so that
/// what jumps from region to region has a value in each. The numbers below `n_nodes` are the nodes
/// themselves, with the least of their regions; the others follow, by node, then by region. Alike
/// on all ranks, which must make it together.
class RegionalNodes {
 public:
  template <int dim>
  explicit RegionalNodes(const Discretisation<dim> &body);

  std::size_t size() const { return least_.size() + others_.size(); }
  Node node(std::size_t number) const {
    return number < least_.size() ? static_cast<Node>(number)
                                  : others_[number - least_.size()].first;
  }
  /// Of a node in one of its regions.
  std::uint32_t number(Node node, std::size_t region) const;
  /// Of this rank's cells, in the order of `for_each_cell`.
  std::span<const std::uint32_t> regions_of_cells() const { return regions_of_cells_; }

 private:
  std::vector<std::uint32_t> regions_of_cells_;
  std::vector<double> least_;                           // region of each node
  std::vector<std::pair<Node, std::uint32_t>> others_;  // node and region, ascending
};

}  // namespace tourmaline::body
