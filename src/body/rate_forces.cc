#include "body/rate_forces.h"

#include <fmt/format.h>

#include <algorithm>

#include "cell_block.h"
#include "parallel/ranks.h"
#include "tourmaline/error.h"

namespace tourmaline::body {

namespace {

std::size_t entry_of(const NodeGraph &graph, Node row, Node column) {
  const auto begin = graph.column.begin() + graph.row[row];
  const auto end = graph.column.begin() + graph.row[row + 1];
  return std::lower_bound(begin, end, column) - graph.column.begin();
}

// (rho v, v) of one cell between its nodes; lumped it is a diagonal in the proportions of this one
// (Hinton, Rock, Zienkiewicz 1976), positive for every shape function.
template <int dim>
Eigen::MatrixXd mass_of(const Quadrature<dim> &cell, double density) {
  const auto n = static_cast<Eigen::Index>(cell.nodes.size());
  Eigen::MatrixXd mass = Eigen::MatrixXd::Zero(n, n);
  for (std::size_t q = 0; q < cell.jxw.size(); ++q) {
    const Eigen::Map<const Eigen::VectorXd> values(&cell.values[q * cell.nodes.size()], n);
    mass += density * cell.jxw[q] * values * values.transpose();
  }
  return mass;
}

Eigen::VectorXd lumped(const Eigen::MatrixXd &mass) {
  return mass.diagonal() * (mass.sum() / mass.trace());
}

// With the stiffness of the viscous stress and nothing else. The permittivity is there for the
// modes' matrix not to be singular.
template <int dim>
material::BodyConstants<dim> viscosity(material::BodyConstants<dim> material) {
  material.stiffness *= material.stiffness_damping;
  material.piezoelectric.setZero();
  material.permittivity.setIdentity();
  material.permittivity *= material.stiffness.trace();
  material.thermal_stress.setZero();
  material.pyroelectric.setZero();
  return material;
}

template <int dim>
using Block = typename RateForces<dim>::Block;

// (F eps(v), eps(v)) of one cell, its modes condensed out, block by block.
template <int dim, class Add>
void add_stiffness(const Quadrature<dim> &cell, const material::BodyConstants<dim> &material,
                   const Add &add) {
  constexpr int n = Fields<dim>::count;
  const std::size_t n_shapes = cell.nodes.size();
  for (std::size_t a = 0; a < n_shapes; ++a)
    for (std::size_t b = 0; b < n_shapes; ++b) {
      Block<dim> block = Block<dim>::Zero();
      for (std::size_t q = 0; q < cell.jxw.size(); ++q)
        block += cell.jxw[q] * strain_of(cell.gradient(q, a), cell.around(q, a)).transpose() *
                 material.stiffness * strain_of(cell.gradient(q, b), cell.around(q, b));
      add(a, b, block);
    }
  if (cell.mode_gradients.empty())
    return;
  const typename CellModes<dim>::Blocks blocks(cell, material);
  const CellModes<dim> modes(cell, blocks);
  for (std::size_t a = 0; a < n_shapes; ++a)
    for (std::size_t b = 0; b < n_shapes; ++b)
      add(a, b,
          Block<dim>(blocks.coupling.template middleCols<dim>(static_cast<int>(n * a)).transpose() *
                     modes.response.template middleCols<dim>(static_cast<int>(n * b))));
}

// On any rank.
bool is_there(const NodeSharing &sharing, const std::vector<double> &masses) {
  double largest = 0;
  for (const double mass : masses)
    largest = std::max(largest, mass);
  return sharing.largest(largest) > 0;
}

}  // namespace

// What the cells add, and where.
template <int dim>
struct RateForces<dim>::Assembly {
  RateForces &to;
  const NodeGraph graph;
  const bool is_linear;  // shape functions are
  // Of cells all of whose nodes are massless, by node: mass, and mass times `mass_damping`.
  std::vector<double> stranded, stranded_drag;

  Assembly(RateForces &forces, const Discretisation<dim> &body)
      : to(forces),
        graph(body.graph()),
        is_linear(body.degree() == 1),
        stranded(graph.n_nodes(), 0.),
        stranded_drag(graph.n_nodes(), 0.) {}

  bool is_at_massless(const Quadrature<dim> &cell) const {
    return std::any_of(cell.nodes.begin(), cell.nodes.end(),
                       [&](Node node) { return to.massless_[node]; });
  }

  std::vector<Node> with_mass(const Quadrature<dim> &cell) const {
    std::vector<Node> nodes;
    std::copy_if(cell.nodes.begin(), cell.nodes.end(), std::back_inserter(nodes),
                 [&](Node node) { return !to.massless_[node]; });
    return nodes;
  }

  void add_damping(bool backward, std::size_t entry, const Block &block) {
    std::vector<Block> &all = backward ? to.backward_damping_ : to.damping_;
    all.resize(graph.column.size(), Block::Zero());
    all[entry] += block;
  }

  void add_mass(Node a, Node b, double mass, double drag) {
    const std::size_t entry = entry_of(graph, a, b);
    to.mass_[entry] += mass;
    if (drag != 0)
      add_damping(!to.is_dynamic_, entry, drag * Block::Identity());
  }

  void add_lumped(const Quadrature<dim> &cell, const Eigen::VectorXd &masses, double drag) {
    const std::vector<Node> takers = with_mass(cell);
    for (std::size_t a = 0; a < cell.nodes.size(); ++a) {
      const Node node = cell.nodes[a];
      const double mass = masses[static_cast<Eigen::Index>(a)];
      if (!to.massless_[node])
        add_mass(node, node, mass, drag * mass);
      for (const Node taker : takers)
        if (const double share = mass / static_cast<double>(takers.size()); to.massless_[node])
          add_mass(taker, taker, share, drag * share);
      if (takers.empty()) {
        stranded[node] += mass;
        stranded_drag[node] += drag * mass;
      }
    }
  }

  void add_cell(const Quadrature<dim> &cell, const material::BodyConstants<dim> &material) {
    if (!(material.density > 0))
      throw CaseError("[material] density: missing, but must be given for inertia and damping");
    const Eigen::MatrixXd mass = mass_of(cell, material.density);
    const bool at_massless = is_at_massless(cell), is_lumped = at_massless || is_linear;
    if (is_lumped)
      add_lumped(cell, lumped(mass), material.mass_damping);
    for (std::size_t a = 0; a < cell.nodes.size() && !is_lumped; ++a)
      for (std::size_t b = 0; b < cell.nodes.size(); ++b) {
        const double entry = mass(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b));
        add_mass(cell.nodes[a], cell.nodes[b], entry, material.mass_damping * entry);
      }
    if (material.stiffness_damping > 0)
      add_stiffness<dim>(cell, viscosity(material),
                         [&](std::size_t a, std::size_t b, const Block &block) {
                           add_damping(!to.is_dynamic_ || at_massless,
                                       entry_of(graph, cell.nodes[a], cell.nodes[b]), block);
                         });
  }
};

template <int dim>
RateForces<dim>::RateForces(const Discretisation<dim> &body,
                            const material::Composition<dim> &composition, Modes modes,
                            bool is_dynamic, const std::vector<bool> &massless)
    : is_dynamic_(is_dynamic), massless_(massless) {
  Assembly assembly(*this, body);
  mass_.assign(assembly.graph.column.size(), 0.);
  parallel::together([&] {
    body.for_each_cell(
        [&](const Quadrature<dim> &cell) {
          assembly.add_cell(cell, composition.at(cell.region, cell.centre()));
        },
        modes);
  });
  body.sharing().add_up(assembly.stranded);
  body.sharing().add_up(assembly.stranded_drag);
  if (is_there(body.sharing(), assembly.stranded))
    add_stranded(body, assembly);
  node_masses_.assign(assembly.graph.n_nodes(), 0.);
  held_back_ = diagonal_ = node_masses_;
  for (Node i = 0; i < assembly.graph.n_nodes(); ++i)
    for (std::size_t e = assembly.graph.row[i]; e < assembly.graph.row[i + 1]; ++e) {
      node_masses_[i] += mass_[e];
      if (assembly.graph.column[e] != i)
        continue;
      diagonal_[i] = mass_[e];
      if (!backward_damping_.empty())
        held_back_[i] = backward_damping_[e].trace();
    }
  body.sharing().add_up(node_masses_);
  body.sharing().add_up(diagonal_);
  body.sharing().add_up(held_back_);
  // Whether there is any damping is known to all ranks, whoever's cells are damped.
  for (std::vector<Block> *blocks : {&damping_, &backward_damping_})
    if (parallel::sum(blocks->empty() ? 0. : 1.) > 0) {
      blocks->resize(assembly.graph.column.size(), Block::Zero());
      is_damped_ = true;
    }
}

// In a corner of the contact a cell may have no other nodes: the nodes with mass of the cells
// around take it, or its neighbours pass it on to theirs.
template <int dim>
void RateForces<dim>::add_stranded(const Discretisation<dim> &body, Assembly &assembly) {
  constexpr int passes = 10;
  std::vector<double> &stranded = assembly.stranded, &drag = assembly.stranded_drag;
  const auto visit = [&](const auto &see) {  // pairs of a stranded node and one beside it
    body.for_each_cell([&](const Quadrature<dim> &cell) {
      for (const Node node : cell.nodes)
        for (const Node other : cell.nodes)
          if (stranded[node] > 0 && other != node)
            see(node, other);
    });
  };
  for (int pass = 0; pass < passes; ++pass) {
    std::vector<double> takers(massless_.size(), 0.), others(takers), left(takers),
        left_drag(takers);
    visit([&](Node node, Node other) { (massless_[other] ? others : takers)[node] += 1; });
    body.sharing().add_up(takers);
    body.sharing().add_up(others);
    visit([&](Node node, Node other) {
      if (!massless_[other]) {
        assembly.add_mass(other, other, stranded[node] / takers[node], drag[node] / takers[node]);
      } else if (takers[node] == 0) {
        left[other] += stranded[node] / others[node];
        left_drag[other] += drag[node] / others[node];
      }
    });
    body.sharing().add_up(left);
    body.sharing().add_up(left_drag);
    stranded = left;
    drag = left_drag;
    if (!is_there(body.sharing(), left))
      return;
  }
  const auto node = std::max_element(stranded.begin(), stranded.end()) - stranded.begin();
  throw CaseError(fmt::format(
      "[time] contact_mass: all nodes around ({:g}, {:g}, {:g}) m belong to the contact, so none "
      "is "
      "left to take their mass; take finer cells there, or contact_mass = \"consistent\"",
      body.points()[node][0], body.points()[node][1], body.points()[node][2]));
}

template <int dim>
typename RateForces<dim>::Block RateForces<dim>::step_block(std::size_t entry, double step) const {
  Block block = Block::Zero();
  if (is_dynamic_)
    block.diagonal().setConstant(4 / (step * step) * mass_[entry]);
  if (!damping_.empty())
    block += 2 / step * damping_[entry];
  if (!backward_damping_.empty())
    block += 1 / step * backward_damping_[entry];
  return block;
}

template <int dim>
void RateForces<dim>::add_of_step(const NodeGraph &graph, double step, std::span<const double> x,
                                  std::span<double> y) const {
  for (Node i = 0; i < graph.n_nodes(); ++i)
    for (std::size_t e = graph.row[i]; e < graph.row[i + 1]; ++e)
      Eigen::Map<Eigen::Matrix<double, dim, 1>>(&y[unknown<dim>(i, 0)]) +=
          step_block(e, step) *
          Eigen::Map<const Eigen::Matrix<double, dim, 1>>(&x[unknown<dim>(graph.column[e], 0)]);
}

template <int dim>
void RateForces<dim>::add(Kind kind, const NodeGraph &graph, std::span<const double> x,
                          std::span<double> y) const {
  using Vector = Eigen::Matrix<double, dim, 1>;
  const std::vector<Block> &blocks = kind == Kind::damping ? damping_ : backward_damping_;
  if (kind != Kind::inertia && blocks.empty())
    return;
  for (Node i = 0; i < graph.n_nodes(); ++i) {
    Vector sum = Vector::Zero();
    for (std::size_t e = graph.row[i]; e < graph.row[i + 1]; ++e) {
      const Eigen::Map<const Vector> at(&x[unknown<dim>(graph.column[e], 0)]);
      if (kind == Kind::inertia)
        sum += mass_[e] * at;
      else
        sum += blocks[e] * at;
    }
    Eigen::Map<Vector>(&y[unknown<dim>(i, 0)]) += sum;
  }
}

template class RateForces<2>;
template class RateForces<3>;

}  // namespace tourmaline::body
