#include "body/cell_modes.h"

#include <gtest/gtest.h>

#include <random>

#include "body/operator.h"
#include "material/orientation.h"
#include "mesh/mesh.h"
#include "tourmaline/case/case.h"

namespace tourmaline::body {
namespace {

using casefile::CellShape;

template <int dim>
material::BodyConstants<dim> barium_titanate() {
  casefile::MaterialCase asked;
  asked.library = "BaTiO3-Liu2014";
  return material::restricted<dim>(
      material::rotated(material::constants_of(asked), material::crystal_axes(asked, dim)));
}

// A square or cube of 0.1 m about (0.05, 0.05).
template <int dim>
Discretisation<dim> box(CellShape shape, int n) {
  casefile::MeshCase mesh;
  mesh.box = casefile::Box{std::vector<double>(dim, 0.), std::vector<double>(dim, 0.1),
                           std::vector<int>(dim, n), shape};
  return {mesh::build<dim>(mesh), 1};
}

// The parts of the stored energy as the balances take them.
template <int dim>
Energies energies(const Operator<dim> &op, const std::vector<double> &x) {
  FieldProducts products;
  op.multiply_by_field(x, products);
  Energies e = op.energy_shift(x);
  for (std::size_t i = 0; i < x.size(); ++i)
    switch (static_cast<int>(i % Fields<dim>::count)) {
      case Fields<dim>::potential:
        e.electric -= x[i] * products.of[1][i] / 2;
        e.coupling -= x[i] * products.of[2][i];
        break;
      case Fields<dim>::temperature:
        e.thermal -= x[i] * products.of[2][i] / 2;
        break;
      default:
        e.elastic += x[i] * products.of[0][i] / 2;
    }
  return e;
}

// One square bent by u_x = kappa x y with theta = tau y at its corners, the electrodes' potential
// 0: inside sigma_yy = 0 and D_y = 0 give eps_yy and d phi/dy, both as y, and no shear is left.
TEST(CellModes, InAPurelyBentSquareEveryEnergyIsTheOneByHand) {
  const auto body = box<2>(CellShape::quadrilateral, 1);
  const auto c = barium_titanate<2>();
  const Operator<2> op(body, c, Modes::incompatible);
  const double kappa = 2e-3, tau = 3;
  std::vector<double> x(body.n_nodes() * 4, 0.);
  for (Node i = 0; i < body.n_nodes(); ++i) {
    const double px = body.points()[i][0] - 0.05, py = body.points()[i][1] - 0.05;
    x[unknown<2>(i, 0)] = kappa * px * py;
    x[unknown<2>(i, Fields<2>::temperature)] = tau * py;
  }
  Eigen::Matrix2d inside;
  inside << c.stiffness(1, 1), c.piezoelectric(1, 1), c.piezoelectric(1, 1), -c.permittivity(1, 1);
  const Eigen::Vector2d from_outside(c.thermal_stress[1] * tau - c.stiffness(0, 1) * kappa,
                                     -c.pyroelectric[1] * tau - c.piezoelectric(1, 0) * kappa);
  const Eigen::Vector2d slope = inside.inverse() * from_outside;  // of eps_yy and of d phi/dy
  const double second_moment = std::pow(0.1, 4) / 12;
  const Eigen::Vector2d strain(kappa, slope[0]);
  const Energies e = energies(op, x);
  const auto close = [](double a, double b) { EXPECT_NEAR(a, b, 1e-9 * std::abs(b)); };
  close(e.elastic, second_moment / 2 * strain.dot(c.stiffness.topLeftCorner<2, 2>() * strain));
  close(e.electric, second_moment / 2 * c.permittivity(1, 1) * slope[1] * slope[1]);
  close(e.thermal, second_moment / 2 * c.heat_capacity * tau * tau);
  close(e.coupling, -second_moment * c.pyroelectric[1] * slope[1] * tau);
}

template <int dim>
void expect_shift_without_sum(CellShape shape) {
  const auto body = box<dim>(shape, 2);
  const Operator<dim> op(body, barium_titanate<dim>(), Modes::incompatible);
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  std::vector<double> x(body.n_nodes() * Fields<dim>::count);
  for (std::size_t i = 0; i < x.size(); ++i)
    x[i] = normal(random) * (i % Fields<dim>::count < dim ? 1e-9 : 1);
  const Energies shift = op.energy_shift(x);
  const double size = std::abs(shift.elastic) + std::abs(shift.electric) + std::abs(shift.thermal) +
                      std::abs(shift.coupling);
  EXPECT_GT(size, 0);
  EXPECT_LT(std::abs(shift.sum()), 1e-11 * size);
}

TEST(CellModes, WhatTheyShiftBetweenTheEnergiesAddsUpToNothing) {
  expect_shift_without_sum<2>(CellShape::quadrilateral);
  expect_shift_without_sum<3>(CellShape::hexahedron);
}

template <int dim>
void expect_symmetric(CellShape shape) {
  const auto body = box<dim>(shape, 2);
  const Operator<dim> op(body, barium_titanate<dim>(), Modes::incompatible);
  const NodeGraph &graph = op.graph();
  for (Node i = 0; i < graph.n_nodes(); ++i)
    for (std::size_t e = graph.row[i]; e < graph.row[i + 1]; ++e) {
      const Node j = graph.column[e];
      const auto begin = graph.column.begin() + graph.row[j],
                 end = graph.column.begin() + graph.row[j + 1];
      const std::size_t mirror = std::lower_bound(begin, end, i) - graph.column.begin();
      const auto a = op.step_block(e, 0.1), b = op.step_block(mirror, 0.1);
      for (int r = 0; r < Fields<dim>::count; ++r)
        for (int s = 0; s < Fields<dim>::count; ++s)
          EXPECT_NEAR(a(r, s), b(s, r),
                      1e-12 * std::sqrt(std::abs(op.diagonal(0.1)[unknown<dim>(i, r)] *
                                                 op.diagonal(0.1)[unknown<dim>(j, s)])));
    }
}

TEST(CellModes, LeaveTheOperatorSymmetric) {
  expect_symmetric<2>(CellShape::quadrilateral);
  expect_symmetric<3>(CellShape::hexahedron);
}

}  // namespace
}  // namespace tourmaline::body
