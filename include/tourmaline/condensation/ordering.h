#pragma once

#include <vector>

#include "tourmaline/body/discretisation.h"

namespace tourmaline::condensation {

/// Nested dissection (METIS) of the node graph: `position[node]` in the order of elimination. All
/// unknowns of a node stay together, so the graph is (dim + 2)^2 times smaller than the matrix.
/// `unknowns[node]` is how many unknowns the node brings.
std::vector<int> nested_dissection(const body::NodeGraph &graph, const std::vector<int> &unknowns);

}  // namespace tourmaline::condensation
