#include "tourmaline/body/locking.h"

#include <algorithm>
#include <numeric>
#include <vector>

#include "cell_block.h"
#include "tourmaline/parallel/ranks.h"

namespace tourmaline::body {

namespace {

template <int dim>
using Strain = Eigen::Matrix<double, material::n_strains<dim>, 1>;

// Energies [J] of all ranks' cells, twice.
struct Shares {
  double elastic = 0, locked = 0;

  double ratio() const {
    std::array<double, 2> sums{elastic, locked};
    parallel::sum(sums);
    return sums[0] > 0 ? std::min(1., sums[1] / sums[0]) : 0;
  }
};

template <int dim>
Strain<dim> strain_at(const Quadrature<dim> &cell, std::size_t q, std::span<const double> state) {
  Strain<dim> strain = Strain<dim>::Zero();
  for (std::size_t a = 0; a < cell.nodes.size(); ++a)
    strain += strain_of(cell.gradient(q, a)) *
              Eigen::Map<const Eigen::Matrix<double, dim, 1>>(&state[unknown<dim>(cell.nodes[a], 0)]);
  return strain;
}

// With the nodes held, the modes of u would release r A^-1 r of twice the energy, r the force on
// them.
template <int dim>
double released(const Quadrature<dim> &cell, const material::BodyConstants<dim> &material,
                std::span<const double> state) {
  using Modes = CellModes<dim>;
  constexpr int n = Fields<dim>::count, n_u = Modes::n_displacement;
  const typename Modes::Blocks blocks(cell, material);
  Eigen::Matrix<double, n_u, 1> force = Eigen::Matrix<double, n_u, 1>::Zero();
  for (int b = 0; b < Modes::n_nodes; ++b)
    force += blocks.coupling.template block<n_u, n>(0, n * b) *
             Eigen::Map<const Eigen::Matrix<double, n, 1>>(&state[unknown<dim>(cell.nodes[b], 0)]);
  return force.dot(
      blocks.stiffness.template topLeftCorner<n_u, n_u>().llt().solve(force));
}

template <int dim>
double by_modes(const Discretisation<dim> &body, const material::Composition<dim> &composition,
                std::span<const double> state) {
  Shares shares;
  body.for_each_cell(
      [&](const Quadrature<dim> &cell) {
        const material::BodyConstants<dim> material = composition.at(cell.region, cell.centre());
        for (std::size_t q = 0; q < cell.jxw.size(); ++q) {
          const Strain<dim> strain = strain_at(cell, q, state);
          shares.elastic += cell.jxw[q] * strain.dot(material.stiffness * strain);
        }
        shares.locked += released(cell, material, state);
      },
      Modes::incompatible);
  return shares.ratio();
}

// One linear simplex, where the strain is constant.
template <int dim>
struct Simplex {
  std::array<Node, dim + 1> nodes;
  std::size_t region;
  double volume;
  Strain<dim> strain;
  Eigen::Matrix<double, material::n_strains<dim>, material::n_strains<dim>> stiffness;
};

template <int dim>
std::vector<Simplex<dim>> simplices(const Discretisation<dim> &body,
                                    const material::Composition<dim> &composition,
                                    std::span<const double> state) {
  std::vector<Simplex<dim>> cells;
  body.for_each_cell([&](const Quadrature<dim> &cell) {
    Simplex<dim> &s = cells.emplace_back();
    std::copy(cell.nodes.begin(), cell.nodes.end(), s.nodes.begin());
    s.region = cell.region;
    s.volume = std::accumulate(cell.jxw.begin(), cell.jxw.end(), 0.);
    s.strain = strain_at(cell, 0, state);
    s.stiffness = composition.at(cell.region, cell.centre()).stiffness;
  });
  return cells;
}

// Means of the strains around each node, weighted with the volumes, of one region's cells.
template <int dim>
std::vector<double> recovered(const std::vector<Simplex<dim>> &cells, std::size_t region,
                              std::size_t n_nodes) {
  constexpr int n = material::n_strains<dim>;
  std::vector<double> sums((n + 1) * n_nodes, 0.);  // of the strains, then of the volumes
  for (const Simplex<dim> &cell : cells)
    if (cell.region == region)
      for (const Node node : cell.nodes) {
        Strain<dim>::Map(&sums[n * std::size_t{node}]) += cell.volume * cell.strain;
        sums[n * n_nodes + node] += cell.volume;
      }
  parallel::sum(sums);
  for (std::size_t node = 0; node < n_nodes; ++node)
    if (const double volume = sums[n * n_nodes + node]; volume > 0)
      Strain<dim>::Map(&sums[n * node]) /= volume;
  return sums;
}

// Twice the energy of a difference of strains that is linear over the cell.
template <int dim>
double energy_of_difference(const Simplex<dim> &cell, const std::vector<double> &recovered) {
  Strain<dim> sum = Strain<dim>::Zero();
  double squares = 0;
  for (const Node node : cell.nodes) {
    const Strain<dim> d =
        Strain<dim>::Map(&recovered[material::n_strains<dim> * std::size_t{node}]) - cell.strain;
    sum += d;
    squares += d.dot(cell.stiffness * d);
  }
  return cell.volume * (squares + sum.dot(cell.stiffness * sum)) / ((dim + 1) * (dim + 2));
}

template <int dim>
double by_recovery(const Discretisation<dim> &body, const material::Composition<dim> &composition,
                   std::span<const double> state) {
  const std::vector<Simplex<dim>> cells = simplices(body, composition, state);
  std::array<double, 1> last{0};
  for (const Simplex<dim> &cell : cells)
    last[0] = std::max(last[0], static_cast<double>(cell.region));
  parallel::largest(last);
  Shares shares;
  for (std::size_t region = 0; region <= static_cast<std::size_t>(last[0]); ++region) {
    const std::vector<double> nodal = recovered(cells, region, body.n_nodes());
    for (const Simplex<dim> &cell : cells)
      if (cell.region == region) {
        shares.elastic += cell.volume * cell.strain.dot(cell.stiffness * cell.strain);
        shares.locked += energy_of_difference(cell, nodal);
      }
  }
  return shares.ratio();
}

}  // namespace

template <int dim>
double locked_share(const Discretisation<dim> &body, const material::Composition<dim> &composition,
                    std::span<const double> state) {
  if (body.degree() > 1)
    return 0;
  return body.has_simplices() ? by_recovery(body, composition, state)
                              : by_modes(body, composition, state);
}

template double locked_share(const Discretisation<2> &, const material::Composition<2> &,
                             std::span<const double>);
template double locked_share(const Discretisation<3> &, const material::Composition<3> &,
                             std::span<const double>);

}  // namespace tourmaline::body
