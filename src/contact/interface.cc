#include "tourmaline/contact/interface.h"

#include <fmt/format.h>

#include <map>

#include "tourmaline/error.h"
#include "tourmaline/parallel/ranks.h"

namespace tourmaline::contact {

namespace {

template <int dim>
using Normal = Eigen::Matrix<double, dim, 1>;

template <int dim>
struct Integrals {
  double weight = 0, size = 0;
  Normal<dim> normal = Normal<dim>::Zero();
};

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
      if (found == by_node.end())
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

// One normal must serve all facets at a node; 45 degrees is far more than a curved side's facets
// differ.
template <int dim>
void check_normals(const body::Discretisation<dim> &body,
                   const std::vector<std::string> &boundaries,
                   const std::vector<InterfaceNode<dim>> &nodes) {
  std::map<body::Node, Normal<dim>> normal_at;
  for (const InterfaceNode<dim> &node : nodes)
    normal_at[node.node] = node.normal;
  body.for_each_facet(boundaries, [&](const body::Quadrature<dim> &facet) {
    for (std::size_t a = 0; a < facet.nodes.size(); ++a) {
      const auto found = normal_at.find(facet.nodes[a]);
      if (found == normal_at.end() || facet.value(0, a) == 0)
        continue;
      if (found->second.dot(Eigen::Map<const Normal<dim>>(facet.normals[0].data())) > 0.75)
        continue;
      const output::Vector &point = body.points()[facet.nodes[a]];
      throw CaseError(
          fmt::format("[contact] at ({:g}, {:g}, {:g}) contact boundaries meet at an angle, where "
                      "the normal is not "
                      "unique; contact around a corner is not available, name one of them",
                      point[0], point[1], point[2]));
    }
  });
}

}  // namespace

template <int dim>
std::vector<InterfaceNode<dim>> interface_nodes(const body::Discretisation<dim> &body,
                                                const std::vector<std::string> &boundaries) {
  std::vector<InterfaceNode<dim>> nodes;
  for (const auto &[node, integrals] : integrate(body, boundaries)) {
    const output::Vector &point = body.points()[node];
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
