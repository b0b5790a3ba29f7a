#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace tourmaline::body {

using Node = unsigned int;

/// How the nodes of a body are shared out to the ranks. Whole, every rank has all of them, and its
/// vectors are those of the body; shared out, it has those of its cells and those that all ranks
/// know, because a condition or a contact stands there. Vectors by node or by unknown are then this
/// rank's part: each entry is that of the whole body, on every rank that has it, and what is summed
/// over nodes is summed over those that count, and then over the ranks.
///
/// A node belongs to the first rank whose cells touch it. Node 0 is the same on all ranks. `Node`
/// numbers this rank's nodes, in the order of their numbers in the whole body.
class NodeSharing {
 public:
  NodeSharing() = default;
  /// Whole; `touched`: whether this rank's cells touch a node. All ranks together, as below where
  /// nothing else is said.
  explicit NodeSharing(const std::vector<bool> &touched);
  /// Shared out: of a whole one what `touched` and `known`, ascending and alike on all ranks,
  /// leave.
  NodeSharing(const NodeSharing &whole, const std::vector<bool> &touched,
              const std::vector<Node> &known);

  bool is_whole() const { return number_.empty(); }
  std::size_t n_all() const { return n_all_; }           ///< nodes of the body
  std::size_t n_nodes() const { return owner_.size(); }  ///< of this rank
  /// Number in the whole body. Does not communicate, as the following.
  Node number(Node node) const { return is_whole() ? node : number_[node]; }
  std::vector<Node> numbers(std::vector<Node> nodes) const;
  /// Nothing: this rank does not have it.
  std::optional<Node> node(Node number) const;
  /// Of nodes by their numbers those that this rank has.
  std::vector<Node> nodes(const std::vector<Node> &numbers) const;
  int rank_of(Node node) const { return owner_[node]; }
  bool is_own(Node node) const { return owner_[node] == rank_; }
  /// Whether this rank counts the node in sums over nodes.
  bool counts(Node node) const { return is_whole() || is_own(node); }

  /// Of vectors of shares by node, with any number of entries for each: every entry becomes the sum
  /// over the ranks.
  void add_up(std::span<double> shares) const;
  /// Of sizes, none below 0: the same of the largest.
  void find_largest(std::span<double> sizes) const;
  /// Every entry becomes that of the rank which the node belongs to.
  void take_from_owners(std::span<double> values) const;

  /// Sums over the nodes that count become sums over all nodes, and largest values of this rank's
  /// nodes those of all.
  void sum(std::span<double> values) const;
  double sum(double value) const;
  void largest(std::span<double> values) const;
  double largest(double value) const;

  /// The vector of the whole body of which this is each rank's part, on the first rank; on the
  /// others, if it is shared out, it is empty.
  std::vector<double> on_first(std::vector<double> part) const;
  /// This rank's part of a vector of the whole body.
  std::vector<double> part_of(std::vector<double> whole) const;

 private:
  /// Nodes that two ranks have, in the order of their numbers.
  struct Neighbour {
    int rank;
    std::vector<Node> own, others;  ///< that belong to this rank, to that one
  };
  void find_neighbours(const std::vector<bool> &touched);
  using Two = double (*)(double, double);
  using All = void (*)(std::span<double>);
  void join(std::span<double> values, Two two, All all) const;
  using Of = std::vector<Node> Neighbour::*;
  void exchange(std::span<double> values, Of sent, Of received, Two two) const;
  void send_to_owners(std::span<double> shares, Two two) const;
  void send_from_owners(std::span<double> values) const;
  void join_known(std::span<double> values, All all,
                  const std::function<bool(Node)> &is_share) const;
  void take_whole_from_owners(std::span<double> values) const;

  int rank_ = 0;  // this one
  std::size_t n_all_ = 0;
  std::vector<int> owner_;             // by node
  std::vector<Node> number_;           // by node; empty: whole
  std::vector<Node> known_;            // to all ranks, if shared out
  std::vector<bool> is_known_;         // by node
  std::vector<Neighbour> neighbours_;  // by rank
};

}  // namespace tourmaline::body
