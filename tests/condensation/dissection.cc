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

// Nodes of n x n x n cubes, each cut into six tetrahedra along its diagonal.
NodeGraph tetrahedra(int n) {
  const auto node = [&](int x, int y, int z) {
    return static_cast<Node>((z * (n + 1) + y) * (n + 1) + x);
  };
  std::vector<std::set<Node>> rows(node(n, n, n) + 1);
  const auto join = [&](Node a, Node b) { rows[a].insert(b), rows[b].insert(a); };
  for (int z = 0; z <= n; ++z)
    for (int y = 0; y <= n; ++y)
      for (int x = 0; x <= n; ++x)
        for (int corner = 0; corner < 8; ++corner)
          if (const std::array to{x + (corner & 1), y + (corner >> 1 & 1), z + (corner >> 2)};
              *std::max_element(to.begin(), to.end()) <= n)
            join(node(x, y, z), node(to[0], to[1], to[2]));
  return graph_of(rows);
}

// Of all nodes, each with unknowns that all couple, eliminated or kept: those that come later than
// one, and are reached through what comes before it, are below its unknowns.
double operations(const NodeGraph &graph, const NodeUnknowns &unknowns,
                  const std::vector<int> &place) {
  std::vector<std::set<int>> below(place.size());
  std::vector<Node> at(place.size());
  for (Node i = 0; i < place.size(); ++i)
    at[place[i]] = i;
  double sum = 0;
  for (const Node i : at) {
    std::set<int> &row = below[place[i]];
    for (std::size_t e = graph.row[i]; e < graph.row[i + std::size_t{1}]; ++e)
      if (place[graph.column[e]] > place[i])
        row.insert(place[graph.column[e]]);
    double height = 0;
    for (const int later : row)
      height += unknowns.eliminated[at[later]] + unknowns.kept[at[later]];
    for (int pivot = 0; pivot < unknowns.eliminated[i]; ++pivot)
      sum += (height + pivot) * (height + pivot);
    if (row.size() > 1)
      below[*row.begin()].insert(std::next(row.begin()), row.end());
    std::set<int>().swap(row);
  }
  return sum;
}

std::vector<int> by_metis_alone(const NodeGraph &graph, const NodeUnknowns &unknowns) {
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
  options[METIS_OPTION_SEED] = 1;
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
  const NodeGraph graph = tetrahedra(20);
  const NodeUnknowns unknowns = each(graph, 10);
  const std::vector<int> place = dissected(graph, unknowns, 3);
  expect_a_place_each(place);
  const double alone = operations(graph, unknowns, by_metis_alone(graph, unknowns));
  EXPECT_LT(operations(graph, unknowns, place), 0.9 * alone);
  EXPECT_EQ(dissected(graph, unknowns, 3), place);
}

// What is kept on one side is below all fronts that reach it.
TEST(Dissection, HasFewerOperationsWhereItKnowsWhatIsKept) {
  const NodeGraph graph = tetrahedra(20);
  NodeUnknowns unknowns = each(graph, 10);
  for (Node i = 0; i < graph.n_nodes(); i += 21) {
    unknowns.eliminated[i] = 0;
    unknowns.kept[i] = 30;
  }
  NodeUnknowns unaware = unknowns;
  unaware.kept.assign(graph.n_nodes(), 0);
  EXPECT_LT(operations(graph, unknowns, dissected(graph, unknowns, 3)),
            0.95 * operations(graph, unknowns, dissected(graph, unaware, 3)));
}

TEST(Dissection, IsThatOfMetisWhereEliminationTakesLittle) {
  const NodeGraph graph = tetrahedra(8);
  const NodeUnknowns unknowns = each(graph, 5);
  EXPECT_EQ(dissected(graph, unknowns, 3), by_metis_alone(graph, unknowns));
}

// Two bodies, the second of which has nothing to eliminate on every other node.
TEST(Dissection, LeavesNodesWithNothingToEliminateToTheEnd) {
  const NodeGraph one = tetrahedra(9);
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
