#include "body/conductors.h"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <numeric>

#include "case/time_steps.h"
#include "case/toml_text.h"
#include "parallel/ranks.h"
#include "tourmaline/case/case.h"
#include "tourmaline/error.h"

namespace tourmaline::body {

namespace {

/// Sets of nodes that grow together; each is named by one of its nodes.
class Pieces {
 public:
  explicit Pieces(std::size_t n_nodes) : parent_(n_nodes) {
    std::iota(parent_.begin(), parent_.end(), Node{0});
  }
  Node of(Node node) {
    while (parent_[node] != node)
      node = parent_[node] = parent_[parent_[node]];
    return node;
  }
  void join(Node a, Node b) { parent_[of(b)] = of(a); }

 private:
  std::vector<Node> parent_;
};

// The piece of every node that belongs to a conductor, by numbers in the whole body.
template <int dim>
std::map<Node, Node> conductors(const Discretisation<dim> &body,
                                const material::Composition<dim> &composition) {
  Pieces own(body.n_nodes());
  std::vector<bool> conducts(body.n_nodes(), false);
  body.for_each_cell([&](const Quadrature<dim> &cell) {
    if (composition.conducts(cell.region))
      for (const Node node : cell.nodes) {
        own.join(cell.nodes.front(), node);
        conducts[node] = true;
      }
  });
  // (node, piece), which pieces of other ranks continue, by numbers in the whole body
  std::vector<Node> pairs;
  const NodeSharing &sharing = body.sharing();
  for (Node node = 0; node < body.n_nodes(); ++node)
    if (conducts[node])
      pairs.insert(pairs.end(), {sharing.number(node), sharing.number(own.of(node))});
  pairs = parallel::joined(pairs);
  Pieces all(sharing.n_all());
  for (std::size_t i = 0; i < pairs.size(); i += 2)
    all.join(pairs[i], pairs[i + 1]);
  std::map<Node, Node> piece;
  for (std::size_t i = 0; i < pairs.size(); i += 2)
    piece[pairs[i]] = all.of(pairs[i]);
  return piece;
}

/// Whatever gives a potential to nodes of a conductor.
class Givers {
 public:
  explicit Givers(const casefile::Case &asked) : asked_(asked) {}

  /// Throws CaseError unless the conductor's other nodes have the same potential.
  void add(Node piece, const Prescribed &p) {
    std::vector<Prescribed> &known = of_[piece];
    for (const Prescribed &other : known)
      if (says_the_same(other, p))
        return;
    if (!known.empty())
      compare(known.front(), p);
    if (known.empty() || !p.value.depends_on_place())
      known.push_back(p);
  }

 private:
  static bool says_the_same(const Prescribed &a, const Prescribed &b) {
    return a.electrode == b.electrode && !a.value.depends_on_place() &&
           a.value.text() == b.value.text();
  }

  const casefile::ElectrodeCase *electrode(const Prescribed &p) const {
    return p.electrode < 0 ? nullptr : &asked_.electrodes[static_cast<std::size_t>(p.electrode)];
  }

  std::string name(const Prescribed &p) const {
    if (const auto *e = electrode(p))
      return fmt::format("{} {}", e->where, casefile::toml_text(e->name));
    return p.value.where().empty() ? "the boundary " + casefile::toml_text(p.boundary)
                                   : p.value.where();
  }

  [[noreturn]] void refuse(const Prescribed &a, const Prescribed &b,
                           const std::string &what) const {
    throw CaseError(fmt::format(
        "{} and {} stand on one conductor, at ({:g}, {:g}, {:g}) and ({:g}, {:g}, {:g}) m, {}; "
        "cells with `conductor = true` that touch have one potential: leave one of the two out, or "
        "part the conductor by an insulating region",
        name(b), name(a), b.point[0], b.point[1], b.point[2], a.point[0], a.point[1], a.point[2],
        what));
  }

  void compare(const Prescribed &a, const Prescribed &b) const {
    if (electrode(a) && electrode(b))
      refuse(a, b, "so that nothing tells which of these electrodes has its charge");
    for (const auto *e : {electrode(a), electrode(b)})
      if (e && !e->is_driven())
        refuse(a, b, "so that the electrode's voltage cannot be found from its circuit");
    const casefile::TimeSteps steps(asked_.time);
    for (int n = 1; n <= steps.count(); ++n) {
      const double time = steps.at(n);
      const double of_a = a.value.value(a.point, time), of_b = b.value.value(b.point, time);
      if (std::abs(of_a - of_b) > 1e-12 * std::max(std::abs(of_a), std::abs(of_b)))
        refuse(a, b, fmt::format("with {:g} V and {:g} V at t = {:g} s", of_b, of_a, time));
    }
  }

  const casefile::Case &asked_;
  std::map<Node, std::vector<Prescribed>> of_;
};

}  // namespace

template <int dim>
void check_conductors(const Discretisation<dim> &body,
                      const material::Composition<dim> &composition, const casefile::Case &asked,
                      const std::vector<Prescribed> &prescribed) {
  if (!composition.has_conductors())
    return;
  const std::map<Node, Node> piece = conductors(body, composition);
  Givers givers(asked);
  parallel::together([&] {
    for (const Prescribed &p : prescribed)
      if (p.unknown % Fields<dim>::count == Fields<dim>::potential)
        if (const auto found = piece.find(
                body.sharing().number(static_cast<Node>(p.unknown / Fields<dim>::count)));
            found != piece.end())
          givers.add(found->second, p);
  });
}

template void check_conductors<2>(const Discretisation<2> &, const material::Composition<2> &,
                                  const casefile::Case &, const std::vector<Prescribed> &);
template void check_conductors<3>(const Discretisation<3> &, const material::Composition<3> &,
                                  const casefile::Case &, const std::vector<Prescribed> &);

}  // namespace tourmaline::body
