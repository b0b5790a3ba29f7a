#pragma once

#include <vector>

#include "body/discretisation.h"

namespace tourmaline::condensation {

/// By node how many unknowns are eliminated, and how many are kept to the end.
struct NodeUnknowns {
  std::vector<int> eliminated, kept;
};

/// Places of the nodes of a body of `dim` dimensions in an order of elimination that has few
/// operations; nodes that have nothing to eliminate come last. Of the largest separators, on which
/// nearly all operations depend, several are sought, and the one is taken with which elimination
/// will take the least, with what lies around it (larger separators, unknowns that are kept); METIS
/// itself would take the smallest of fewer. The more elimination takes, the more are sought; the
/// rest is METIS's nested dissection. The same graph has the same order. A MachineError where METIS
/// fails.
std::vector<int> dissected(const body::NodeGraph &graph, const NodeUnknowns &unknowns, int dim);

}  // namespace tourmaline::condensation
