#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "body/discretisation.h"

namespace tourmaline::body {

/// A body's nodes by region: where regions meet, a node is there once for each of them, so that
/// what jumps from region to region has a value in each. The numbers below `n_nodes` are the nodes
/// themselves, with the least of their regions; the others follow, by node, then by region. A rank
/// has those of its nodes; all must make it together.
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

  /// The same numbers in the whole body, alike on all ranks, and how many there are.
  std::uint32_t number_in_whole(std::size_t number) const;
  std::size_t size_of_whole() const { return size_of_whole_; }

 private:
  static constexpr auto none = std::numeric_limits<std::uint32_t>::max();

  template <int dim>
  std::vector<double> nodes_in(const Discretisation<dim> &body, std::uint32_t region) const;
  void add(std::uint32_t region, const std::vector<double> &is_there);
  void number_others();

  const NodeSharing &sharing_;
  std::vector<std::uint32_t> regions_of_cells_;
  std::vector<std::uint32_t> least_;                    // region of each node
  std::vector<std::pair<Node, std::uint32_t>> others_;  // node and region, ascending
  std::vector<std::uint32_t> numbers_of_others_;        // in the whole body
  std::size_t size_of_whole_ = 0;
};

}  // namespace tourmaline::body
