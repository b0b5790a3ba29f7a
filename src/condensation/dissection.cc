#include "condensation/dissection.h"

#include <metis.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "condensation/elimination.h"
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
};

// Separates nodes into two parts that have no edge between them.
struct Split {
  Nodes first, second, separator;
};

class Dissection {
 public:
  Dissection(const NodeGraph &graph, const NodeUnknowns &unknowns, int dim);
  std::vector<int> places();

 private:
  void order(const Nodes &nodes, int begin);
  void order_by_metis(const Nodes &nodes, int begin);
  int tries(const Nodes &nodes);
  Split best_split(const Nodes &nodes, int tries);
  double seconds(const Split &split, double around);
  double expected_seconds(double unknowns, double around) const;
  MetisGraph part(const Nodes &nodes);
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
  order(nodes, 0);
  auto behind = static_cast<int>(nodes.size());
  for (const Node node : others)
    place_[node] = behind++;
  return std::move(place_);
}

// Places from `begin` on, the separator's last.
void Dissection::order(const Nodes &nodes, int begin) {
  if (nodes.empty())
    return;
  const int n_tries = tries(nodes);
  if (n_tries <= 1)
    return order_by_metis(nodes, begin);
  const Split split = best_split(nodes, n_tries);
  if (split.first.empty() || split.second.empty())
    return order_by_metis(nodes, begin);
  order(split.first, begin);
  begin += static_cast<int>(split.first.size());
  order(split.second, begin);
  begin += static_cast<int>(split.second.size());
  for (const Node node : split.separator)
    place_[node] = begin++;
}

void Dissection::order_by_metis(const Nodes &nodes, int begin) {
  MetisGraph graph = part(nodes);
  auto n = static_cast<idx_t>(nodes.size());
  std::vector<idx_t> order(n), place(n);
  check(METIS_NodeND(&n, graph.start.data(), graph.neighbour.data(), graph.weight.data(),
                     options(1).data(), order.data(), place.data()));
  for (idx_t i = 0; i < n; ++i)
    place_[nodes[i]] = begin + place[i];
}

// How many separators may be looked for.
int Dissection::tries(const Nodes &nodes) {
  auto edges = static_cast<double>(nodes.size());
  for (const Node node : nodes)
    edges += static_cast<double>(neighbours(node).size());
  const double expected = expected_seconds(unknowns_of(nodes), unknowns_around(nodes));
  return static_cast<int>(
      std::min<double>(share_of_search * expected / (seconds_by_edge * edges), most_tries));
}

// Parts of unlike size may have the smaller separator between them.
Split Dissection::best_split(const Nodes &nodes, int tries) {
  MetisGraph graph = part(nodes);
  idx_t n = static_cast<idx_t>(nodes.size()), weight = 0;
  std::vector<idx_t> side(n);
  Split best;
  const double around = unknowns_around(nodes);
  double least = INFINITY;
  for (int t = 0; t < tries; ++t) {
    Options chosen = options(t + 1);
    chosen[METIS_OPTION_UFACTOR] = std::array{200, 400, 100, 600}[t % 4];  // thousandths
    check(METIS_ComputeVertexSeparator(&n, graph.start.data(), graph.neighbour.data(),
                                       graph.weight.data(), chosen.data(), &weight, side.data()));
    Split split;
    for (idx_t i = 0; i < n; ++i)
      (side[i] == 0   ? split.first
       : side[i] == 1 ? split.second
                      : split.separator)
          .push_back(nodes[i]);
    if (const double taken = seconds(split, around); taken < least) {
      least = taken;
      best = std::move(split);
    }
  }
  return best;
}

double Dissection::seconds(const Split &split, double around) {
  double sum = Front::seconds(unknowns_of(split.separator), around);
  for (const Nodes *side : {&split.first, &split.second})
    sum += expected_seconds(unknowns_of(*side), unknowns_around(*side));
  return sum;
}

// Of so many unknowns with so many others around them that come later: as of a cube or a square,
// which is halved until little is left.
double Dissection::expected_seconds(double unknowns, double around) const {
  double sum = 0;
  for (double parts = 1; unknowns > 100; parts *= 2) {
    const double separator = unknowns_by_node_ * std::pow(unknowns / unknowns_by_node_, exponent_);
    sum += parts * Front::seconds(separator, around);
    unknowns = (unknowns - separator) / 2;
    around = around / 2 + separator;
  }
  return sum;
}

MetisGraph Dissection::part(const Nodes &nodes) {
  static_assert(sizeof(idx_t) == sizeof(int));
  mark(nodes);
  MetisGraph part;
  for (const Node node : nodes) {
    for (const Node other : neighbours(node))
      if (other != node && mark_[other] == marked_)
        part.neighbour.push_back(number_[other]);
    part.start.push_back(static_cast<idx_t>(part.neighbour.size()));
    part.weight.push_back(unknowns_.eliminated[node]);
  }
  return part;
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
