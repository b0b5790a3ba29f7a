#include "condensation/ordering.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <numeric>
#include <set>
#include <vector>

namespace tourmaline::condensation {
namespace {

// Nodes of n x n squares, each joined with those of its squares and with itself.
body::NodeGraph grid(int n) {
  body::NodeGraph graph;
  graph.row.push_back(0);
  for (int y = 0; y <= n; ++y)
    for (int x = 0; x <= n; ++x) {
      for (int v = std::max(y - 1, 0); v <= std::min(y + 1, n); ++v)
        for (int u = std::max(x - 1, 0); u <= std::min(x + 1, n); ++u)
          graph.column.push_back(static_cast<body::Node>(v * (n + 1) + u));
      graph.row.push_back(graph.column.size());
    }
  return graph;
}

// Entries below the diagonal of the factor, by elimination of the graph.
std::size_t entries(const body::NodeGraph &graph, const std::vector<int> &position) {
  std::vector<std::set<int>> behind(position.size());
  for (std::size_t i = 0; i < position.size(); ++i)
    for (std::size_t e = graph.row[i]; e < graph.row[i + 1]; ++e)
      if (const int other = position[graph.column[e]]; other > position[i])
        behind[position[i]].insert(other);
  std::size_t sum = 0;
  for (std::set<int> &row : behind) {
    sum += row.size();
    if (row.empty())
      continue;
    const int next = *row.begin();
    behind[next].insert(std::next(row.begin()), row.end());
  }
  return sum;
}

TEST(NestedDissection, GivesEveryNodeAPlaceAndTheFactorFewerEntriesThanTheBandOfTheMesh) {
  constexpr int n = 60;
  const body::NodeGraph graph = grid(n);
  const std::size_t n_nodes = graph.n_nodes();
  const std::vector<int> position =
      nested_dissection(graph, {std::vector<int>(n_nodes, 4), std::vector<int>(n_nodes, 0)}, 2);
  EXPECT_EQ(std::set<int>(position.begin(), position.end()).size(), n_nodes);
  std::vector<int> as_numbered(n_nodes);
  std::iota(as_numbered.begin(), as_numbered.end(), 0);
  // n^3 of the band, and of nested dissection n^2 log n.
  EXPECT_LT(entries(graph, position), 0.5 * static_cast<double>(entries(graph, as_numbered)));
}

}  // namespace
}  // namespace tourmaline::condensation
