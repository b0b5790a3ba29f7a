#include "condensation/ordering.h"

#include <metis.h>

#include <algorithm>

#include "parallel/ranks.h"
#include "tourmaline/error.h"

namespace tourmaline::condensation {

namespace {

using body::Node;
using body::NodeGraph;

// The rows that are not empty, each as its node, its length and its columns.
std::vector<Node> packed(const NodeGraph &graph) {
  std::vector<Node> rows;
  for (Node i = 0; i < graph.n_nodes(); ++i)
    if (const std::size_t length = graph.row[i + std::size_t{1}] - graph.row[i]; length > 0) {
      rows.insert(rows.end(), {i, static_cast<Node>(length)});
      rows.insert(rows.end(), graph.column.begin() + graph.row[i],
                  graph.column.begin() + graph.row[i + std::size_t{1}]);
    }
  return rows;
}

// Rows of all ranks, those of one node merged.
NodeGraph merged(const std::vector<Node> &rows, std::size_t n_nodes) {
  std::vector<std::vector<Node>> columns(n_nodes);
  for (std::size_t at = 0; at < rows.size(); at += 2 + rows[at + 1])
    columns[rows[at]].insert(columns[rows[at]].end(), rows.begin() + at + 2,
                             rows.begin() + at + 2 + rows[at + 1]);
  NodeGraph graph;
  graph.row.push_back(0);
  for (std::vector<Node> &row : columns) {
    std::sort(row.begin(), row.end());
    graph.column.insert(graph.column.end(), row.begin(), std::unique(row.begin(), row.end()));
    graph.row.push_back(graph.column.size());
  }
  return graph;
}

std::vector<int> dissected(const NodeGraph &graph, const std::vector<int> &unknowns) {
  static_assert(sizeof(idx_t) == sizeof(int));
  idx_t n = static_cast<idx_t>(graph.n_nodes());
  std::vector<idx_t> start{0}, neighbour, weight(unknowns), order(n), position(n);
  neighbour.reserve(graph.column.size());
  for (idx_t i = 0; i < n; ++i) {
    for (std::size_t e = graph.row[i]; e < graph.row[i + 1]; ++e)
      if (graph.column[e] != static_cast<Node>(i))
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

}  // namespace

std::vector<int> nested_dissection(const NodeGraph &graph, const std::vector<int> &unknowns) {
  if (parallel::n_ranks() == 1)
    return dissected(graph, unknowns);
  const std::vector<Node> rows = parallel::joined_on_first(packed(graph));
  std::vector<int> position(graph.n_nodes());
  parallel::on_first([&] { position = dissected(merged(rows, graph.n_nodes()), unknowns); });
  parallel::from_first(std::span<int>(position));
  return position;
}

}  // namespace tourmaline::condensation
