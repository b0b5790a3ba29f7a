#include "contact/interface.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
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

// Every rank has all nodes, and of their integrals what its facets contribute.
template <int dim>
void sum_over_ranks(std::map<body::Node, Integrals<dim>> &by_node) {
  std::vector<double> plain;
  for (const auto &[node, integrals] : by_node) {
    plain.insert(plain.end(), {integrals.weight, integrals.size});
    plain.insert(plain.end(), integrals.normal.begin(), integrals.normal.end());
  }
  parallel::sum(plain);
  const double *next = plain.data();
  for (auto &[node, integrals] : by_node) {
    integrals = {next[0], next[1], Eigen::Map<const Normal<dim>>(next + 2)};
    next += 2 + dim;
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

template <int dim>
std::vector<InterfaceNode<dim>> interface_nodes(const body::Discretisation<dim> &body,
                                                const std::vector<std::string> &boundaries) {
  std::vector<InterfaceNode<dim>> nodes;
  for (const auto &[node, integrals] : integrate(body, boundaries)) {
    const Vector3 &point = body.points()[node];
    if (!(integrals.weight > 1e-9 * integrals.size))
      throw CaseError(
          fmt::format("[contact] the node at ({:g}, {:g}, {:g}) has no positive weight in the "
                      "nodal quadrature; "
                      "contact on tetrahedra needs mesh.degree = 1",
                      point[0], point[1], point[2]));
    nodes.push_back({node, point, integrals.weight, integrals.normal.normalized()});
  }
  parallel::together([&] { check_normals(body, boundaries, nodes); });
  return nodes;
}

template std::vector<InterfaceNode<2>> interface_nodes<2>(const body::Discretisation<2> &,
                                                          const std::vector<std::string> &);
template std::vector<InterfaceNode<3>> interface_nodes<3>(const body::Discretisation<3> &,
                                                          const std::vector<std::string> &);

}  // namespace tourmaline::contact
