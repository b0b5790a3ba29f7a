#include "condensation/dissection.h"

#include <metis.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "condensation/elimination.h"
#include "condensation/pages.h"
#include "tourmaline/error.h"

namespace tourmaline::condensation {

namespace {

using body::Node;
using body::NodeGraph;
using Nodes = std::vector<Node>;

constexpr double seconds_by_edge = 1e-7;      // of METIS looking for a separator
constexpr double share_of_search = 1. / 200;  // of what elimination is expected to take, by level
constexpr int most_tries = 16;

using Options = std::array<idx_t, METIS_NOPTIONS>;

Options options(int seed) {
  Options options;
  METIS_SetDefaultOptions(options.data());
  options[METIS_OPTION_SEED] = seed;
  return options;
}

void check(int outcome) {
  if (outcome != METIS_OK)
    throw MachineError("METIS could not order the unknowns (memory?)");
}

// Some of the nodes in METIS's form.
struct MetisGraph {
  std::vector<idx_t> start{0}, neighbour, weight;

  idx_t n_nodes() const { return static_cast<idx_t>(weight.size()); }
};

// Separates nodes into two parts that have no edge between them.
struct Split {
  Nodes first, second, separator;
};

// METIS ends the program where it finds no memory for a separator.
void expect_room(const MetisGraph &graph) {
  const Pages room(10 * graph.neighbour.size() + 40 * graph.weight.size());
}

class Dissection {
 public:
  Dissection(const NodeGraph &graph, const NodeUnknowns &unknowns, int dim);
  std::vector<int> places();

 private:
  void order(const Nodes &nodes, int begin, double girth);
  void order_by_metis(const Nodes &nodes, int begin);
  int tries(const Nodes &nodes, double girth);
  Split split(const Nodes &nodes, double &girth);
  Split candidate(const Nodes &nodes, MetisGraph &graph, int seed) const;
  double seconds(const Split &split, double around, double girth);
  double expected_seconds(double unknowns, double around, double girth) const;
  double separator_of_cube(double unknowns) const;
  MetisGraph part(const Nodes &nodes);
  std::size_t edges_of(const Nodes &nodes) const;
  double unknowns_of(const Nodes &nodes) const;
  double unknowns_around(const Nodes &nodes);
  void mark(const Nodes &nodes);
  std::span<const Node> neighbours(Node node) const;

  const NodeGraph &graph_;
  const NodeUnknowns &unknowns_;
  std::vector<int> place_;
  double exponent_;              // of a separator's size in that of what it separates
  double unknowns_by_node_ = 0;  // the mean
  std::vector<int> mark_;        // by node the set that it was marked in last
  std::vector<idx_t> number_;    // in that set
  int marked_ = 0;
};

Dissection::Dissection(const NodeGraph &graph, const NodeUnknowns &unknowns, int dim)
    : graph_(graph),
      unknowns_(unknowns),
      place_(graph.n_nodes()),
      exponent_((dim - 1.) / dim),
      mark_(graph.n_nodes(), 0),
      number_(graph.n_nodes()) {}

// METIS does not come to an end with many nodes that weigh nothing.
std::vector<int> Dissection::places() {
  Nodes nodes, others;
  for (Node i = 0; i < graph_.n_nodes(); ++i)
    (unknowns_.eliminated[i] > 0 ? nodes : others).push_back(i);
  unknowns_by_node_ =
      unknowns_of(nodes) / static_cast<double>(std::max<std::size_t>(nodes.size(), 1));
  order(nodes, 0, 1);
  auto behind = static_cast<int>(nodes.size());
  for (const Node node : others)
    place_[node] = behind++;
  return std::move(place_);
}

// Places from `begin` on, the separator's last. `girth` is what a separator has of one of a cube,
// or square, that is as large.
void Dissection::order(const Nodes &nodes, int begin, double girth) {
  if (nodes.empty())
    return;
  const Split best = tries(nodes, girth) > 1 ? split(nodes, girth) : Split();
  if (best.first.empty())
    return order_by_metis(nodes, begin);
  order(best.first, begin, girth);
  begin += static_cast<int>(best.first.size());
  order(best.second, begin, girth);
  begin += static_cast<int>(best.second.size());
  for (const Node node : best.separator)
    place_[node] = begin++;
}

void Dissection::order_by_metis(const Nodes &nodes, int begin) {
  MetisGraph graph = part(nodes);
  idx_t n = graph.n_nodes();
  std::vector<idx_t> order(n), place(n);
  check(METIS_NodeND(&n, graph.start.data(), graph.neighbour.data(), graph.weight.data(),
                     options(1).data(), order.data(), place.data()));
  for (idx_t i = 0; i < n; ++i)
    place_[nodes[i]] = begin + place[i];
}

// How many separators may be looked for.
int Dissection::tries(const Nodes &nodes, double girth) {
  const double one = seconds_by_edge * static_cast<double>(nodes.size() + edges_of(nodes));
  const double expected = expected_seconds(unknowns_of(nodes), unknowns_around(nodes), girth);
  return static_cast<int>(std::min<double>(share_of_search * expected / one, most_tries));
}

// The best of those that may be looked for; of none that is worth it nothing. The first tells the
// girth.
Split Dissection::split(const Nodes &nodes, double &girth) {
  MetisGraph graph = part(nodes);
  const double around = unknowns_around(nodes);
  Split best = candidate(nodes, graph, 1);
  girth = unknowns_of(best.separator) / separator_of_cube(unknowns_of(nodes));
  const int n_tries = tries(nodes, girth);
  if (n_tries <= 1)
    return {};
  double least = seconds(best, around, girth);
  for (int seed = 2; seed <= n_tries; ++seed) {
    Split other = candidate(nodes, graph, seed);
    if (const double taken = seconds(other, around, girth); taken < least * (1 - 1e-9)) {
      least = taken;
      best = std::move(other);
    }
  }
  return least < INFINITY ? best : Split();
}

// Parts of unlike size may have the smaller separator between them.
Split Dissection::candidate(const Nodes &nodes, MetisGraph &graph, int seed) const {
  Options chosen = options(seed);
  chosen[METIS_OPTION_UFACTOR] = std::array{600, 200, 400, 100}[seed % 4];  // thousandths
  idx_t n = graph.n_nodes(), weight = 0;
  std::vector<idx_t> side(n);
  expect_room(graph);
  check(METIS_ComputeVertexSeparator(&n, graph.start.data(), graph.neighbour.data(),
                                     graph.weight.data(), chosen.data(), &weight, side.data()));
  Split split;
  for (idx_t i = 0; i < n; ++i)
    (side[i] == 0   ? split.first
     : side[i] == 1 ? split.second
                    : split.separator)
        .push_back(nodes[i]);
  return split;
}

double Dissection::seconds(const Split &split, double around, double girth) {
  if (split.first.empty() || split.second.empty())
    return INFINITY;
  double sum = Front::seconds(unknowns_of(split.separator), around);
  for (const Nodes *side : {&split.first, &split.second})
    sum += expected_seconds(unknowns_of(*side), unknowns_around(*side), girth);
  return sum;
}

// Of so many unknowns with so many others around them that come later, halved until little is left.
// As parts are no cubes, more than half of what is around one is around its halves: fitted.
double Dissection::expected_seconds(double unknowns, double around, double girth) const {
  double sum = 0;
  for (double parts = 1; unknowns > 100; parts *= 2) {
    const double separator = std::min(girth * separator_of_cube(unknowns), unknowns);
    sum += parts * Front::seconds(separator, around);
    unknowns = (unknowns - separator) / 2;
    around = 0.7 * around + separator;
  }
  return sum;
}

double Dissection::separator_of_cube(double unknowns) const {
  return unknowns_by_node_ * std::pow(unknowns / unknowns_by_node_, exponent_);
}

MetisGraph Dissection::part(const Nodes &nodes) {
  static_assert(sizeof(idx_t) == sizeof(int));
  mark(nodes);
  MetisGraph part;
  part.neighbour.reserve(edges_of(nodes));
  for (const Node node : nodes) {
    for (const Node other : neighbours(node))
      if (other != node && mark_[other] == marked_)
        part.neighbour.push_back(number_[other]);
    part.start.push_back(static_cast<idx_t>(part.neighbour.size()));
    part.weight.push_back(unknowns_.eliminated[node]);
  }
  return part;
}

std::size_t Dissection::edges_of(const Nodes &nodes) const {
  std::size_t sum = 0;
  for (const Node node : nodes)
    sum += neighbours(node).size();
  return sum;
}

double Dissection::unknowns_of(const Nodes &nodes) const {
  double sum = 0;
  for (const Node node : nodes)
    sum += unknowns_.eliminated[node];
  return sum;
}

// Neighbours outside are in larger separators.
double Dissection::unknowns_around(const Nodes &nodes) {
  mark(nodes);
  double sum = 0;
  for (const Node node : nodes) {
    sum += unknowns_.kept[node];
    for (const Node other : neighbours(node))
      if (std::exchange(mark_[other], marked_) != marked_)
        sum += unknowns_.eliminated[other] + unknowns_.kept[other];
  }
  return sum;
}

void Dissection::mark(const Nodes &nodes) {
  ++marked_;
  idx_t number = 0;
  for (const Node node : nodes) {
    mark_[node] = marked_;
    number_[node] = number++;
  }
}

std::span<const Node> Dissection::neighbours(Node node) const {
  const auto first = graph_.column.begin() + static_cast<std::ptrdiff_t>(graph_.row[node]);
  return {first,
          graph_.column.begin() + static_cast<std::ptrdiff_t>(graph_.row[node + std::size_t{1}])};
}

}  // namespace

std::vector<int> dissected(const NodeGraph &graph, const NodeUnknowns &unknowns, int dim) {
  return Dissection(graph, unknowns, dim).places();
}

}  // namespace tourmaline::condensation
