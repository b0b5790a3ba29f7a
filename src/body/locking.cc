#include "body/locking.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "cell_block.h"
#include "output/records.h"
#include "parallel/ranks.h"

namespace tourmaline::body {

namespace {

template <int dim>
using Strain = Eigen::Matrix<double, material::n_strains<dim>, 1>;

// Energies [J] of this rank's cells, twice.
struct Held {
  double strain = 0, stress = 0, locked = 0;

  LockedShare shares() const {
    std::array<double, 3> sums{strain, stress, locked};
    parallel::sum(sums);
    const auto share = [&](double whole) { return whole > 0 ? std::min(1., sums[2] / whole) : 0; };
    return {share(sums[0]), share(sums[1])};
  }
};

// At a point: strain and stress (1).
template <int dim>
struct Loaded {
  Strain<dim> strain = Strain<dim>::Zero(), stress = Strain<dim>::Zero();

  Loaded(const Quadrature<dim> &cell, std::size_t q, const material::BodyConstants<dim> &material,
         std::span<const double> state) {
    Eigen::Matrix<double, dim, 1> slope = Eigen::Matrix<double, dim, 1>::Zero();
    double theta = 0;
    for (std::size_t a = 0; a < cell.nodes.size(); ++a) {
      const double *x = &state[unknown<dim>(cell.nodes[a], 0)];
      const auto &g = cell.gradient(q, a);
      strain +=
          strain_of(g, cell.around(q, a)) * Eigen::Map<const Eigen::Matrix<double, dim, 1>>(x);
      slope +=
          x[Fields<dim>::potential] * Eigen::Map<const Eigen::Matrix<double, dim, 1>>(g.data());
      theta += x[Fields<dim>::temperature] * cell.value(q, a);
    }
    stress = material.stiffness * strain + material.piezoelectric.transpose() * slope -
             material.thermal_stress * theta;
  }
};

// In a plane the stress across it does no work.
template <int dim>
material::BodyConstants<dim> that_works(const Quadrature<dim> &cell,
                                        material::BodyConstants<dim> material) {
  constexpr int zz = 2;
  if (dim == 3 || !cell.inverse_radius.empty())
    return material;
  const double size = material.stiffness(zz, zz);
  material.stiffness.row(zz).setZero();
  material.stiffness.col(zz).setZero();
  material.stiffness(zz, zz) = size;
  material.piezoelectric.col(zz).setZero();
  material.thermal_stress[zz] = 0;
  return material;
}

template <int dim>
Held held(const Quadrature<dim> &cell, const material::BodyConstants<dim> &all,
          std::span<const double> state) {
  Held sum;
  const material::BodyConstants<dim> material = that_works(cell, all);
  const auto compliance = material.stiffness.llt();
  for (std::size_t q = 0; q < cell.jxw.size(); ++q) {
    const Loaded<dim> at(cell, q, material, state);
    sum.strain += cell.jxw[q] * at.strain.dot(material.stiffness * at.strain);
    sum.stress += cell.jxw[q] * at.stress.dot(compliance.solve(at.stress));
  }
  return sum;
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
  return force.dot(blocks.stiffness.template topLeftCorner<n_u, n_u>().llt().solve(force));
}

template <int dim>
LockedShare by_modes(const Discretisation<dim> &body, const material::Composition<dim> &composition,
                     std::span<const double> state) {
  Held all;
  body.for_each_cell(
      [&](const Quadrature<dim> &cell) {
        const material::BodyConstants<dim> material = composition.at(cell.region, cell.centre());
        const Held of_cell = held(cell, material, state);
        all.strain += of_cell.strain;
        all.stress += of_cell.stress;
        all.locked += released(cell, material, state);
      },
      Modes::incompatible);
  return all.shares();
}

// One linear simplex, where the strain is constant, but around an axis.
template <int dim>
struct Simplex {
  std::array<Node, dim + 1> nodes;
  std::size_t region;
  double volume;
  Held held;
  Strain<dim> strain;
  Eigen::Matrix<double, material::n_strains<dim>, material::n_strains<dim>> stiffness;
};

template <int dim>
Strain<dim> mean_strain(const Quadrature<dim> &cell, const material::BodyConstants<dim> &material,
                        std::span<const double> state, double volume) {
  Strain<dim> sum = Strain<dim>::Zero();
  for (std::size_t q = 0; q < cell.jxw.size(); ++q)
    sum += cell.jxw[q] / volume * Loaded<dim>(cell, q, material, state).strain;
  return sum;
}

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
    const material::BodyConstants<dim> material = composition.at(cell.region, cell.centre());
    s.held = held(cell, material, state);
    s.strain = mean_strain(cell, material, state, s.volume);
    s.stiffness = material.stiffness;
  });
  return cells;
}

// Means of the strains around each node, weighted with the volumes, of one region's cells.
template <int dim>
std::vector<double> recovered(const std::vector<Simplex<dim>> &cells, std::size_t region,
                              const NodeSharing &sharing) {
  constexpr int n = material::n_strains<dim>;
  std::vector<double> sums(n * sharing.n_nodes(), 0.), volumes(sharing.n_nodes(), 0.);
  for (const Simplex<dim> &cell : cells)
    if (cell.region == region)
      for (const Node node : cell.nodes) {
        Strain<dim>::Map(&sums[n * std::size_t{node}]) += cell.volume * cell.strain;
        volumes[node] += cell.volume;
      }
  sharing.add_up(sums);
  sharing.add_up(volumes);
  for (std::size_t node = 0; node < volumes.size(); ++node)
    if (volumes[node] > 0)
      Strain<dim>::Map(&sums[n * node]) /= volumes[node];
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
LockedShare by_recovery(const Discretisation<dim> &body,
                        const material::Composition<dim> &composition,
                        std::span<const double> state) {
  const std::vector<Simplex<dim>> cells = simplices(body, composition, state);
  std::array<double, 1> last{0};
  for (const Simplex<dim> &cell : cells)
    last[0] = std::max(last[0], static_cast<double>(cell.region));
  parallel::largest(last);
  Held all;
  for (std::size_t region = 0; region <= static_cast<std::size_t>(last[0]); ++region) {
    const std::vector<double> nodal = recovered(cells, region, body.sharing());
    for (const Simplex<dim> &cell : cells)
      if (cell.region == region) {
        all.strain += cell.held.strain;
        all.stress += cell.held.stress;
        all.locked += energy_of_difference(cell, nodal);
      }
  }
  return all.shares();
}

}  // namespace

template <int dim>
LockedShare locked_share(const Discretisation<dim> &body,
                         const material::Composition<dim> &composition,
                         std::span<const double> state) {
  if (body.degree() > 1)
    return {};
  return body.has_simplices() ? by_recovery(body, composition, state)
                              : by_modes(body, composition, state);
}

namespace {

// The largest distance between two nodes.
template <int dim>
double size_of(const Quadrature<dim> &cell, const std::vector<Vector3> &points) {
  double largest = 0;
  for (const Node a : cell.nodes)
    for (const Node b : cell.nodes)
      largest = std::max(
          largest,
          (Eigen::Vector3d::Map(points[a].data()) - Eigen::Vector3d::Map(points[b].data())).norm());
  return largest;
}

double diagonal(const std::array<Vector3, 2> &bounds) {
  return (Eigen::Vector3d::Map(bounds[1].data()) - Eigen::Vector3d::Map(bounds[0].data())).norm();
}

}  // namespace

template <int dim>
Slenderness slenderness(const Discretisation<dim> &body) {
  std::array<double, 3> sums{};  // volume, volume times size of the cells, surface
  body.for_each_cell([&](const Quadrature<dim> &cell) {
    const double volume = std::accumulate(cell.jxw.begin(), cell.jxw.end(), 0.);
    sums[0] += volume;
    sums[1] += volume * size_of(cell, body.points());
  });
  std::vector<std::string> names;
  for (const output::NamedBoundary &boundary : body.boundaries())
    if (!boundary.inside)
      names.push_back(boundary.name);
  body.for_each_facet(names, [&](const Quadrature<dim> &facet) {
    sums[2] += std::accumulate(facet.jxw.begin(), facet.jxw.end(), 0.);
  });
  parallel::sum(sums);
  if (sums[2] == 0)
    return {};
  const double thickness = 2 * sums[0] / sums[2];
  return {.ratio = diagonal(body.bounds()) / (thickness * dim * std::sqrt(dim)),
          .cells = thickness * sums[0] / sums[1]};
}

template Slenderness slenderness(const Discretisation<2> &);
template Slenderness slenderness(const Discretisation<3> &);

template LockedShare locked_share(const Discretisation<2> &, const material::Composition<2> &,
                                  std::span<const double>);
template LockedShare locked_share(const Discretisation<3> &, const material::Composition<3> &,
                                  std::span<const double>);

}  // namespace tourmaline::body
