#include "tourmaline/condensation/ordering.h"

#include <metis.h>

#include "tourmaline/error.h"

namespace tourmaline::condensation {

std::vector<int> nested_dissection(const body::NodeGraph &graph, const std::vector<int> &unknowns) {
  static_assert(sizeof(idx_t) == sizeof(int));
  idx_t n = static_cast<idx_t>(graph.n_nodes());
  std::vector<idx_t> start{0}, neighbour, weight(unknowns), order(n), position(n);
  neighbour.reserve(graph.column.size());
  for (idx_t i = 0; i < n; ++i) {
    for (std::size_t e = graph.row[i]; e < graph.row[i + 1]; ++e)
      if (graph.column[e] != static_cast<body::Node>(i))
        neighbour.push_back(static_cast<idx_t>(graph.column[e]));
    start.push_back(static_cast<idx_t>(neighbour.size()));
  }
  idx_t options[METIS_NOPTIONS];
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_SEED] = 1;  // same case, same bytes
  if (METIS_NodeND(&n, start.data(), neighbour.data(), weight.data(), options, order.data(),
                   position.data()) != METIS_OK)
    throw MachineError("METIS could not order the unknowns (memory?)");
  return position;
}

}  // namespace tourmaline::condensation
