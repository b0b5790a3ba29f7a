#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace tourmaline::condensation {

/// A symmetric matrix by groups of variables that have the same neighbours, those of a node. Groups
/// are numbered in the order of elimination; the last `kept` are not eliminated.
struct GroupedMatrix {
  std::vector<int> variables;       ///< of all groups, one after another, numbered from 0
  std::vector<int> first{0};        ///< by group, where its variables begin; and their end
  std::vector<std::size_t> row{0};  ///< by group, where its neighbours begin; and their end
  std::vector<int> neighbour;       ///< groups; each pair twice, each group itself once
  /// Entries of the rows of `group` and the columns of the neighbour at `entry`, by rows.
  std::function<void(const GroupedMatrix &, int group, std::size_t entry, double *values)> block;
  int kept = 0;

  int size() const { return static_cast<int>(first.size()) - 1; }
  int size(int group) const { return first[group + 1] - first[group]; }
  int eliminated() const { return size() - kept; }
};

}  // namespace tourmaline::condensation
