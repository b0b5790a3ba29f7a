#include "contact/interface.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numbers>
#include <set>

#include "parallel/ranks.h"
#include "tourmaline/error.h"

namespace tourmaline::contact {

namespace {

template <int dim>
using Normal = Eigen::Matrix<double, dim, 1>;

template <int dim>
struct Integrals {
  double weight = 0, size = 0;
  double slight = 0;  // facets of which the node has hardly a share
  Normal<dim> normal = Normal<dim>::Zero();
};

// Of the nodes of the facet's cell those on the facet. Round-off keeps the shape functions of the
// others from being 0 there; those of the facet's own nodes are far from 0 at one point at least.
template <int dim>
bool lies_on(const body::Quadrature<dim> &facet, std::size_t a) {
  constexpr double round_off = 1e-10;
  for (std::size_t q = 0; q < facet.jxw.size(); ++q)
    if (std::abs(facet.value(q, a)) > round_off)
      return true;
  return false;
}

// Of a facet of degree 2 that begins beside the axis of a revolved body, its first node: its weight
// goes to zero with its radius, and the force on it does not. `hardly` stands at 1/50 of the
// facet's length, where tractions are 0.5 % off.
template <int dim>
bool has_hardly_a_share(const body::Discretisation<dim> &body, const body::Quadrature<dim> &facet,
                        std::size_t a) {
  constexpr double hardly = 0.0064;
  if (body.geometry() != body::Geometry::revolved || body.degree() == 1)
    return false;
  double own = 0, whole = 0;
  for (std::size_t q = 0; q < facet.jxw.size(); ++q) {
    own += facet.jxw[q] * facet.value(q, a);
    whole += facet.jxw[q];
  }
  return own < hardly * whole;
}

// Every rank has all nodes of the contact, and of their integrals what its facets contribute.
template <int dim>
void sum_over_ranks(std::map<body::Node, Integrals<dim>> &by_node) {
  std::vector<double> plain;
  for (const auto &[node, integrals] : by_node) {
    plain.insert(plain.end(), {integrals.weight, integrals.size, integrals.slight});
    plain.insert(plain.end(), integrals.normal.begin(), integrals.normal.end());
  }
  parallel::sum(plain);
  const double *next = plain.data();
  for (auto &[node, integrals] : by_node) {
    integrals = {next[0], next[1], next[2], Eigen::Map<const Normal<dim>>(next + 3)};
    next += 3 + dim;
  }
}

template <int dim>
std::map<body::Node, Integrals<dim>> integrate(const body::Discretisation<dim> &body,
                                               const std::vector<std::string> &boundaries) {
  std::map<body::Node, Integrals<dim>> by_node;
  for (const body::Node node : body.nodes_on(boundaries))
    by_node[node] = {};
  body.for_each_facet(boundaries, [&](const body::Quadrature<dim> &facet) {
    for (std::size_t a = 0; a < facet.nodes.size(); ++a) {
      const auto found = by_node.find(facet.nodes[a]);
      if (found == by_node.end() || !lies_on(facet, a))
        continue;
      if (has_hardly_a_share(body, facet, a))
        found->second.slight += 1;
      for (std::size_t q = 0; q < facet.jxw.size(); ++q) {
        const double share = facet.jxw[q] * facet.value(q, a);
        found->second.weight += share;
        found->second.size += std::abs(share);
        found->second.normal += share * Eigen::Map<const Normal<dim>>(facet.normals[q].data());
      }
    }
  });
  sum_over_ranks(by_node);
  return by_node;
}

}  // namespace

namespace {

double degrees(double cosine) {
  return std::acos(std::clamp(cosine, -1., 1.)) * 180 / std::numbers::pi;
}

// One normal must serve all facets at a node. Facets that stand at 41 degrees to it are far more
// than a curved side's, whose angles halve with its cells, and less than those of a square edge.
constexpr double least_cosine = 0.75;

// A node where the contact boundary has an edge or a corner.
struct Edge {
  double cosine = 1;                 // of the facet that differs most from the mean normal
  std::set<std::string> boundaries;  // of the facets at the node
};

template <int dim>
std::map<body::Node, Edge> facets_at_nodes(const body::Discretisation<dim> &body,
                                           const std::vector<std::string> &boundaries,
                                           const std::vector<InterfaceNode<dim>> &nodes) {
  std::map<body::Node, Normal<dim>> normal_at;
  for (const InterfaceNode<dim> &node : nodes)
    normal_at[node.node] = node.normal;
  std::map<body::Node, Edge> all;
  for (const std::string &name : boundaries)
    body.for_each_facet({name}, [&](const body::Quadrature<dim> &facet) {
      for (std::size_t a = 0; a < facet.nodes.size(); ++a) {
        const auto found = normal_at.find(facet.nodes[a]);
        if (found == normal_at.end() || !lies_on(facet, a))
          continue;
        Edge &edge = all[facet.nodes[a]];
        edge.boundaries.insert(name);
        edge.cosine = std::min(
            edge.cosine, found->second.dot(Eigen::Map<const Normal<dim>>(facet.normals[0].data())));
      }
    });
  return all;
}

template <int dim>
void check_normals(const body::Discretisation<dim> &body,
                   const std::vector<std::string> &boundaries,
                   const std::vector<InterfaceNode<dim>> &nodes) {
  auto edges = facets_at_nodes(body, boundaries, nodes);
  std::erase_if(edges, [](const auto &entry) { return entry.second.cosine > least_cosine; });
  if (edges.empty())
    return;
  const auto &[node, edge] = *edges.begin();
  const Vector3 &point = body.points()[node];
  throw CaseError(fmt::format(
      "[contact] at ({:g}, {:g}, {:g}){} the normal is not unique: facets of {} stand at {:.0f} "
      "degrees to the mean of their normals, more than {:.0f}; contact around an edge is not "
      "available, {}",
      point[0], point[1], point[2],
      edges.size() > 1 ? fmt::format(" and {} further nodes", edges.size() - 1) : "",
      fmt::join(edge.boundaries, " and "), degrees(edge.cosine), degrees(least_cosine),
      edge.boundaries.size() > 1 ? "name one of the boundaries"
                                 : "take smaller cells where the boundary is curved"));
}

}  // namespace

namespace {

template <int dim>
using ByNode = std::map<body::Node, Integrals<dim>>;

// The nodes of two contacts.
template <int dim>
std::vector<body::Node> shared(const ByNode<dim> &one, const ByNode<dim> &other) {
  std::vector<body::Node> nodes;
  for (const auto &[node, integrals] : other)
    if (one.contains(node))
      nodes.push_back(node);
  return nodes;
}

template <int dim>
std::vector<InterfaceNode<dim>> of_contact(const std::vector<InterfaceNode<dim>> &nodes,
                                           std::size_t contact) {
  std::vector<InterfaceNode<dim>> some;
  std::copy_if(nodes.begin(), nodes.end(), std::back_inserter(some),
               [&](const InterfaceNode<dim> &at) { return at.contact == contact; });
  return some;
}

/// Puts contacts together, one after the other.
template <int dim>
class Joined {
 public:
  explicit Joined(const body::Discretisation<dim> &body) : body_(body) {}

  void add(const std::vector<std::string> &boundaries) {
    const ByNode<dim> added = integrate(body_, boundaries);
    const std::size_t contact = all_.size();
    all_.push_back(boundaries);
    const std::vector<body::Node> meeting = shared(by_node_, added);
    const std::vector<double> edges = n_edges(meeting, added);
    for (const auto &[node, integrals] : added)
      if (by_node_.try_emplace(node, integrals).second)
        contacts_at_[node] = {contact};
    for (std::size_t i = 0; i < meeting.size(); ++i) {
      if (edges[i] > 0) {
        edges_.insert(meeting[i]);
        continue;
      }
      by_node_[meeting[i]] = sum(by_node_.at(meeting[i]), added.at(meeting[i]));
      contacts_at_[meeting[i]].push_back(contact);
    }
  }

  const ByNode<dim> &by_node() const { return by_node_; }
  std::size_t first_at(body::Node node) const { return contacts_at_.at(node).front(); }
  std::vector<body::Node> edges() const { return {edges_.begin(), edges_.end()}; }

 private:
  static Integrals<dim> sum(const Integrals<dim> &one, const Integrals<dim> &other) {
    return {one.weight + other.weight, one.size + other.size, one.slight + other.slight,
            one.normal + other.normal};
  }

  // How many of the facets at each node stand at an edge to the normal that the node would have
  // with those of the contact that is added last.
  std::vector<double> n_edges(const std::vector<body::Node> &nodes,
                              const ByNode<dim> &added) const {
    std::vector<double> n(nodes.size(), 0.);
    for (std::size_t contact = 0; !nodes.empty() && contact < all_.size(); ++contact)
      body_.for_each_facet(all_[contact], [&](const body::Quadrature<dim> &facet) {
        for (std::size_t a = 0; a < facet.nodes.size(); ++a) {
          const auto at = std::lower_bound(nodes.begin(), nodes.end(), facet.nodes[a]);
          if (at == nodes.end() || *at != facet.nodes[a] || !lies_on(facet, a))
            continue;
          const std::vector<std::size_t> &there = contacts_at_.at(*at);
          if (contact + 1 < all_.size() &&
              std::find(there.begin(), there.end(), contact) == there.end())
            continue;
          const Normal<dim> normal = sum(by_node_.at(*at), added.at(*at)).normal.normalized();
          n[static_cast<std::size_t>(at - nodes.begin())] +=
              normal.dot(Eigen::Map<const Normal<dim>>(facet.normals[0].data())) > least_cosine ? 0
                                                                                                : 1;
        }
      });
    parallel::sum(n);
    return n;
  }

  const body::Discretisation<dim> &body_;
  std::vector<std::vector<std::string>> all_;
  ByNode<dim> by_node_;
  std::map<body::Node, std::vector<std::size_t>> contacts_at_;  // that count there
  std::set<body::Node> edges_;
};

}  // namespace

// Where the contact of a revolved body meets its axis, the normals of all around add up to one
// along it.
template <int dim>
Normal<dim> normal_of(Normal<dim> integral, bool is_on_axis) {
  if (is_on_axis)
    integral[0] = 0;
  return integral.normalized();
}

template <int dim>
Interface<dim> interface_of(const body::Discretisation<dim> &body,
                            const std::vector<std::vector<std::string>> &contacts) {
  Joined<dim> joined(body);
  for (const std::vector<std::string> &boundaries : contacts)
    joined.add(boundaries);
  Interface<dim> interface { {}, joined.edges() };
  std::vector<InterfaceNode<dim>> &nodes = interface.nodes;
  for (const auto &[node, integrals] : joined.by_node()) {
    const Vector3 &point = body.points()[node];
    if (integrals.slight > 0)
      throw CaseError(fmt::format(
          "[contact] the node at ({:g}, {:g}) m, on the axis or close to it, has hardly any weight "
          "in the nodal quadrature; contact that reaches the axis, or nearly so, needs mesh.degree "
          "= 1",
          point[0], point[1]));
    if (!(integrals.weight > 1e-9 * integrals.size))
      throw CaseError(
          fmt::format("[contact] the node at ({:g}, {:g}, {:g}) has no positive weight in the "
                      "nodal quadrature; "
                      "contact on tetrahedra needs mesh.degree = 1",
                      point[0], point[1], point[2]));
    nodes.push_back({node, point, integrals.weight,
                     normal_of<dim>(integrals.normal, body.is_on_axis(node)),
                     joined.first_at(node)});
  }
  parallel::together([&] {
    for (std::size_t contact = 0; contact < contacts.size(); ++contact) {
      const std::vector<InterfaceNode<dim>> own = of_contact(nodes, contact);
      if (own.empty())
        throw CaseError("[contact] on \"" + contacts[contact].front() +
                        "\": contacts before it have all of its nodes, where they meet it; take "
                        "finer cells, or leave it out");
      check_normals(body, contacts[contact], own);
    }
  });
  return interface;
}

template <int dim>
std::vector<InterfaceNode<dim>> interface_nodes(const body::Discretisation<dim> &body,
                                                const std::vector<std::string> &boundaries) {
  return interface_of<dim>(body, std::vector<std::vector<std::string>>{boundaries}).nodes;
}

template std::vector<InterfaceNode<2>> interface_nodes<2>(const body::Discretisation<2> &,
                                                          const std::vector<std::string> &);
template std::vector<InterfaceNode<3>> interface_nodes<3>(const body::Discretisation<3> &,
                                                          const std::vector<std::string> &);
template Interface<2> interface_of<2>(const body::Discretisation<2> &,
                                      const std::vector<std::vector<std::string>> &);
template Interface<3> interface_of<3>(const body::Discretisation<3> &,
                                      const std::vector<std::vector<std::string>> &);

}  // namespace tourmaline::contact
