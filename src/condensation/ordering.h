#pragma once

#include <vector>

#include "body/discretisation.h"

namespace tourmaline::condensation {

/// Nested dissection (METIS) of the node graph: `position[node]` in the order of elimination. All
/// unknowns of a node stay together, so the graph is (dim + 2)^2 times smaller than the matrix.
/// `unknowns[node]` is how many unknowns the node brings. On several ranks `graph` is each rank's
/// share; the first rank orders the whole, so the order is that of one rank.
std::vector<int> nested_dissection(const body::NodeGraph &graph, const std::vector<int> &unknowns);

}  // namespace tourmaline::condensation
