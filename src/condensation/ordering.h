#pragma once

#include <vector>

#include "body/discretisation.h"
#include "condensation/dissection.h"

namespace tourmaline::condensation {

/// Nested dissection of the node graph: `position[node]` in the order of elimination. All
/// unknowns of a node stay together, so the graph is (dim + 2)^2 times smaller than the matrix.
/// The body has `dim` dimensions. On several ranks `graph` is each rank's share; the first rank
/// orders the whole, so the order is that of one rank.
std::vector<int> nested_dissection(const body::NodeGraph &graph, const NodeUnknowns &unknowns,
                                   int dim);

}  // namespace tourmaline::condensation
