#include "condensation/ordering.h"

#include <algorithm>

#include "condensation/dissection.h"
#include "parallel/ranks.h"

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

}  // namespace

std::vector<int> nested_dissection(const NodeGraph &graph, const NodeUnknowns &unknowns, int dim) {
  if (parallel::n_ranks() == 1)
    return dissected(graph, unknowns, dim);
  const std::vector<Node> rows = parallel::joined_on_first(packed(graph));
  std::vector<int> position(graph.n_nodes());
  parallel::on_first([&] { position = dissected(merged(rows, graph.n_nodes()), unknowns, dim); });
  parallel::from_first(std::span<int>(position));
  return position;
}

}  // namespace tourmaline::condensation
