#pragma once

#include <array>
#include <cmath>

#include "body/node_sharing.h"

namespace tourmaline::solve {

/// A sum with the sum of the sizes of its terms, by which an imbalance is measured.
struct SizedSum {
  double value = 0, size = 0;

  void add(double term) {
    value += term;
    size += std::abs(term);
  }
  /// Of terms over the nodes that count here that of all nodes. All ranks together.
  SizedSum of_all(const body::NodeSharing &sharing) const {
    std::array<double, 2> both{value, size};
    sharing.sum(both);
    return {both[0], both[1]};
  }
};

}  // namespace tourmaline::solve
