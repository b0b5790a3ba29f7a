#include "condensation/dissection.h"

#include <gtest/gtest.h>
#include <metis.h>

#include <algorithm>
#include <array>
#include <set>
#include <vector>

namespace tourmaline::condensation {
namespace {

using body::Node;
using body::NodeGraph;

NodeGraph graph_of(const std::vector<std::set<Node>> &rows) {
  NodeGraph graph;
  graph.row.push_back(0);
  for (const std::set<Node> &row : rows) {
    graph.column.insert(graph.column.end(), row.begin(), row.end());
    graph.row.push_back(graph.column.size());
  }
  return graph;
}

// Nodes of l x m x n cubes, each cut into six tetrahedra along its diagonal, by x, then y, then z.
NodeGraph tetrahedra(int l, int m, int n) {
  const auto node = [&](int x, int y, int z) {
    return static_cast<Node>((z * (m + 1) + y) * (l + 1) + x);
  };
  std::vector<std::set<Node>> rows(node(l, m, n) + 1);
  const auto join = [&](Node a, Node b) { rows[a].insert(b), rows[b].insert(a); };
  for (int z = 0; z <= n; ++z)
    for (int y = 0; y <= m; ++y)
      for (int x = 0; x <= l; ++x)
        for (int corner = 0; corner < 8; ++corner)
          if (const std::array to{x + (corner & 1), y + (corner >> 1 & 1), z + (corner >> 2)};
              to[0] <= l && to[1] <= m && to[2] <= n)
            join(node(x, y, z), node(to[0], to[1], to[2]));
  return graph_of(rows);
}

// Where all unknowns of neighbours couple. Below those of a node are those of later nodes, and what
// is kept of all, that it reaches through what comes before it.
double operations(const NodeGraph &graph, const NodeUnknowns &unknowns,
                  const std::vector<int> &place) {
  const auto n = static_cast<int>(place.size());
  std::vector<std::set<int>> below(place.size());  // places; n and more: of what is kept
  std::vector<double> size(2 * place.size());
  std::vector<Node> at(place.size());
  for (Node i = 0; i < place.size(); ++i) {
    at[place[i]] = i;
    size[place[i]] = unknowns.eliminated[i];
    size[n + place[i]] = unknowns.kept[i];
  }
  double sum = 0;
  for (int p = 0; p < n; ++p) {
    std::set<int> &row = below[p];
    for (std::size_t e = graph.row[at[p]]; e < graph.row[at[p] + std::size_t{1}]; ++e) {
      const int other = place[graph.column[e]];
      if (other > p)
        row.insert(other);
      if (size[n + other] > 0)
        row.insert(n + other);
    }
    double height = 0;
    for (const int later : row)
      height += size[later];
    for (int pivot = 0; pivot < size[p]; ++pivot)
      sum += (height + pivot) * (height + pivot);
    if (!row.empty() && *row.begin() < n)
      below[*row.begin()].insert(std::next(row.begin()), row.end());
    std::set<int>().swap(row);
  }
  return sum;
}

std::vector<int> by_metis_alone(const NodeGraph &graph, const NodeUnknowns &unknowns,
                                int seed = 1) {
  std::vector<idx_t> start{0}, neighbour, weight(unknowns.eliminated), order(graph.n_nodes()),
      place(graph.n_nodes());
  for (Node i = 0; i < graph.n_nodes(); ++i) {
    for (std::size_t e = graph.row[i]; e < graph.row[i + std::size_t{1}]; ++e)
      if (graph.column[e] != i)
        neighbour.push_back(static_cast<idx_t>(graph.column[e]));
    start.push_back(static_cast<idx_t>(neighbour.size()));
  }
  auto n = static_cast<idx_t>(graph.n_nodes());
  idx_t options[METIS_NOPTIONS];
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_SEED] = seed;
  METIS_NodeND(&n, start.data(), neighbour.data(), weight.data(), options, order.data(),
               place.data());
  return place;
}

NodeUnknowns each(const NodeGraph &graph, int unknowns) {
  return {std::vector<int>(graph.n_nodes(), unknowns), std::vector<int>(graph.n_nodes(), 0)};
}

void expect_a_place_each(const std::vector<int> &place) {
  std::vector<int> sorted = place;
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t i = 0; i < sorted.size(); ++i)
    ASSERT_EQ(sorted[i], i);
}

// So many unknowns that a search is worth its while.
TEST(Dissection, HasFewerOperationsThanMetisAlone) {
  const NodeGraph graph = tetrahedra(20, 20, 20);
  const NodeUnknowns unknowns = each(graph, 10);
  const std::vector<int> place = dissected(graph, unknowns, 3);
  expect_a_place_each(place);
  double alone = 0;
  for (int seed = 1; seed <= 3; ++seed)
    alone += operations(graph, unknowns, by_metis_alone(graph, unknowns, seed)) / 3;
  EXPECT_LT(operations(graph, unknowns, place), 0.95 * alone);
}

// What is kept on one side is below all fronts that reach it.
TEST(Dissection, HasFewerOperationsWhereItKnowsWhatIsKept) {
  const NodeGraph graph = tetrahedra(18, 18, 18);
  NodeUnknowns unknowns = each(graph, 10);
  for (Node i = 0; i < graph.n_nodes(); i += 19)
    unknowns.eliminated[i] = 1, unknowns.kept[i] = 20;
  NodeUnknowns unaware = unknowns;
  unaware.kept.assign(graph.n_nodes(), 0);
  EXPECT_LT(operations(graph, unknowns, dissected(graph, unknowns, 3)),
            operations(graph, unknowns, dissected(graph, unaware, 3)));
}

TEST(Dissection, IsThatOfMetisWhereEliminationTakesLittle) {
  const NodeGraph graph = tetrahedra(8, 8, 8);
  const NodeUnknowns unknowns = each(graph, 5);
  EXPECT_EQ(dissected(graph, unknowns, 3), by_metis_alone(graph, unknowns));
}

// The first separator of a bar tells that elimination takes far less than that of a cube.
TEST(Dissection, IsThatOfMetisWhereSeparatorsAreSmall) {
  const NodeGraph graph = tetrahedra(2, 2, 800);
  const NodeUnknowns unknowns = each(graph, 10);
  EXPECT_EQ(dissected(graph, unknowns, 3), by_metis_alone(graph, unknowns));
}

// Two bodies, the second of which has nothing to eliminate on every other node.
TEST(Dissection, LeavesNodesWithNothingToEliminateToTheEnd) {
  const NodeGraph one = tetrahedra(9, 9, 9);
  const auto n = static_cast<Node>(one.n_nodes());
  NodeGraph both = one;
  for (std::size_t i = 1; i < one.row.size(); ++i)
    both.row.push_back(one.row.back() + one.row[i]);
  for (const Node column : one.column)
    both.column.push_back(column + n);
  NodeUnknowns unknowns = each(both, 60);
  for (Node i = n; i < 2 * n; i += 2)
    std::swap(unknowns.eliminated[i], unknowns.kept[i]);
  const std::vector<int> place = dissected(both, unknowns, 3);
  expect_a_place_each(place);
  const auto eliminated = static_cast<int>(n + n / 2);
  for (Node i = 0; i < 2 * n; ++i)
    EXPECT_EQ(place[i] >= eliminated, unknowns.eliminated[i] == 0) << i;
}

TEST(Dissection, TakesWhatHasNoSeparator) {
  for (const int n : {0, 1, 2, 200}) {
    std::vector<std::set<Node>> rows(n);
    for (std::set<Node> &row : rows)
      for (int i = 0; i < n; ++i)
        row.insert(static_cast<Node>(i));
    const NodeGraph all_with_all = graph_of(rows);
    expect_a_place_each(dissected(all_with_all, each(all_with_all, 100), 3));
    const NodeGraph none_with_any = graph_of(std::vector<std::set<Node>>(n));
    expect_a_place_each(dissected(none_with_any, each(none_with_any, 1000), 2));
  }
}

}  // namespace
}  // namespace tourmaline::condensation
