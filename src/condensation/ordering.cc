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

// The nodes that have unknowns: METIS does not come to an end with many that weigh nothing.
std::vector<idx_t> weighing(const std::vector<int> &unknowns) {
  std::vector<idx_t> nodes;
  for (std::size_t i = 0; i < unknowns.size(); ++i)
    if (unknowns[i] > 0)
      nodes.push_back(static_cast<idx_t>(i));
  return nodes;
}

// The others come behind them, as they may.
std::vector<int> dissected(const NodeGraph &graph, const std::vector<int> &unknowns) {
  static_assert(sizeof(idx_t) == sizeof(int));
  const std::vector<idx_t> nodes = weighing(unknowns);
  auto n = static_cast<idx_t>(nodes.size());
  std::vector<int> all(unknowns.size(), -1);
  for (idx_t i = 0; i < n; ++i)
    all[nodes[i]] = i;
  std::vector<idx_t> start{0}, neighbour, weight, order(n), position(n);
  neighbour.reserve(graph.column.size());
  for (const idx_t node : nodes) {
    for (std::size_t e = graph.row[node]; e < graph.row[node + std::size_t{1}]; ++e)
      if (const int other = all[graph.column[e]]; other >= 0 && other != all[node])
        neighbour.push_back(other);
    start.push_back(static_cast<idx_t>(neighbour.size()));
    weight.push_back(unknowns[node]);
  }
  idx_t options[METIS_NOPTIONS];
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_SEED] = 1;  // same case, same bytes
  if (n > 0 && METIS_NodeND(&n, start.data(), neighbour.data(), weight.data(), options,
                            order.data(), position.data()) != METIS_OK)
    throw MachineError("METIS could not order the unknowns (memory?)");
  int behind = n;
  for (int &place : all)
    place = place >= 0 ? position[place] : behind++;
  return all;
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
