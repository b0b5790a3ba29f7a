// Stresses at the nodes: exact where they can be, of the right order elsewhere, apart where regions
// meet.
#include "body/recovery.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "body/derived.h"
#include "body/operator.h"
#include "mesh/mesh.h"
#include "tourmaline/case/case.h"

namespace tourmaline::body {
namespace {

using casefile::CellShape;
using output::SymmetricTensor;

casefile::Case asked(int dimension) {
  casefile::Case asked;
  asked.dimension = dimension;
  asked.material.library = "BaTiO3-Liu2014";
  return asked;
}

/// The unit square or cube of n cells along each axis.
template <int dim>
Discretisation<dim> box(CellShape shape, int degree, int n) {
  casefile::MeshCase mesh;
  mesh.box = casefile::Box{std::vector<double>(dim, 0.), std::vector<double>(dim, 1.),
                           std::vector<int>(dim, n), shape};
  return {mesh::build<dim>(mesh), degree};
}

template <int dim, class Displacement, class Potential, class Temperature>
std::vector<double> interpolated(const Discretisation<dim> &body, const Displacement &u,
                                 const Potential &phi, const Temperature &theta) {
  std::vector<double> state(body.n_nodes() * Fields<dim>::count);
  for (Node i = 0; i < body.n_nodes(); ++i) {
    const Eigen::Vector3d x(body.points()[i].data());
    for (int c = 0; c < dim; ++c)
      state[unknown<dim>(i, c)] = u(x)[c];
    state[unknown<dim>(i, Fields<dim>::potential)] = phi(x);
    state[unknown<dim>(i, Fields<dim>::temperature)] = theta(x);
  }
  return state;
}

/// (1) by hand from the gradients of u and phi and from theta.
SymmetricTensor stress(const material::Constants &c, const Eigen::Matrix3d &h,
                       const Eigen::Vector3d &potential_gradient, double theta) {
  material::Voigt strain;
  strain << h(0, 0), h(1, 1), h(2, 2), h(1, 2) + h(2, 1), h(0, 2) + h(2, 0), h(0, 1) + h(1, 0);
  const material::Voigt s = c.stiffness * strain +
                            c.piezoelectric.transpose() * potential_gradient -
                            c.thermal_stress * theta;
  return {s[0], s[1], s[2], s[5], s[3], s[4]};
}

double largest(const std::vector<SymmetricTensor> &tensors) {
  double size = 0;
  for (const SymmetricTensor &t : tensors)
    for (const double v : t)
      size = std::max(size, std::abs(v));
  return size;
}

template <int dim>
std::vector<SymmetricTensor> recovered(const Discretisation<dim> &body,
                                       const material::Composition<dim> &composition,
                                       const std::vector<double> &state) {
  return Recovery<dim>(body)(composition, state, derived_fields(body, composition, state).stress);
}

/// Largest difference to the exact stress at a node that is `margin` or more away from the
/// boundary, over the largest stress.
template <int dim, class Exact>
double error(const Discretisation<dim> &body, const std::vector<SymmetricTensor> &stress,
             const Exact &exact, double margin = 0) {
  double worst = 0;
  for (Node i = 0; i < body.n_nodes(); ++i) {
    bool inside = true;
    for (int axis = 0; axis < dim; ++axis)
      inside = inside && std::abs(body.points()[i][axis] - 0.5) <= 0.5 - margin;
    if (!inside)
      continue;
    const SymmetricTensor wanted = exact(Eigen::Vector3d(body.points()[i].data()));
    for (std::size_t c = 0; c < wanted.size(); ++c)
      worst = std::max(worst, std::abs(stress[i][c] - wanted[c]));
  }
  return worst / largest(stress);
}

constexpr std::array shapes_2d{CellShape::triangle, CellShape::quadrilateral};
constexpr std::array shapes_3d{CellShape::tetrahedron, CellShape::hexahedron};

// u and phi are quadratic, theta is linear, so that (1) is linear. Linear shape functions have
// linear stresses from theta only.
template <int dim>
void expect_linear_stresses(CellShape shape, int degree, int n) {
  SCOPED_TRACE(::testing::Message() << dim << "D, shape " << static_cast<int>(shape) << ", degree "
                                    << degree << ", " << n << " cells");
  const auto body = box<dim>(shape, degree, n);
  const material::Composition<dim> composition(asked(dim));
  const double q = degree == 2 ? 1e-6 : 0;
  Eigen::Matrix3d h;
  h << 1, 2, 0.5, -1, 3, 0.2, 0.7, -0.4, 2;
  h *= 1e-6;
  if (dim == 2) {
    h.row(2).setZero();
    h.col(2).setZero();
  }
  const Eigen::Vector3d g(3, -2, dim == 3 ? 1 : 0), mask(1, 1, dim == 3 ? 1 : 0);
  const auto u = [&](const Eigen::Vector3d &x) -> Eigen::Vector3d {
    return h * x + q * Eigen::Vector3d(x[0] * x[0] - x[0] * x[1], x[1] * x[1] + 2 * x[0] * x[1],
                                       x[0] * x[2] - x[2] * x[2]);
  };
  const auto gradient = [&](const Eigen::Vector3d &x) -> Eigen::Matrix3d {
    Eigen::Matrix3d quadratic;
    quadratic << 2 * x[0] - x[1], -x[0], 0, 2 * x[1], 2 * x[1] + 2 * x[0], 0, x[2], 0,
        x[0] - 2 * x[2];
    return h + q * quadratic;
  };
  const auto theta = [](const Eigen::Vector3d &x) { return 1 + 2 * x[0] - 3 * x[1] + x[2]; };
  const auto state = interpolated<dim>(
      body, u, [&](const Eigen::Vector3d &x) { return g.dot(x) + 1e6 * q * x[0] * x[1]; }, theta);
  const material::Constants c = composition.in_space(0, {});
  EXPECT_LT(error<dim>(body, recovered(body, composition, state),
                       [&](const Eigen::Vector3d &x) {
                         const Eigen::Vector3d e = g + 1e6 * q * Eigen::Vector3d(x[1], x[0], 0);
                         Eigen::Matrix3d du = gradient(x);
                         if (dim == 2) {
                           du.row(2).setZero();
                           du.col(2).setZero();
                         }
                         return stress(c, du, e.cwiseProduct(mask), theta(x));
                       }),
            1e-10);
}

TEST(Recovery, IsExactForLinearStressesOnEveryShapeOfCellAndDegree) {
  for (const int degree : {1, 2}) {
    for (const CellShape shape : shapes_2d)
      for (const int n : {3, 4})
        expect_linear_stresses<2>(shape, degree, n);
    for (const CellShape shape : shapes_3d)
      expect_linear_stresses<3>(shape, degree, 3);
  }
}

// A bilinear u at the nodes of a square, whose cell means are exact in the centres only.
TEST(Recovery, ReachesTheBoundaryOfLinearQuadrilateralsWhereMeansOfCellsDoNot) {
  const auto body = box<2>(CellShape::quadrilateral, 1, 4);
  const material::Composition<2> composition(asked(2));
  const auto zero = [](const Eigen::Vector3d &) { return 0.; };
  const auto state = interpolated<2>(
      body, [](const Eigen::Vector3d &x) { return Eigen::Vector3d(1e-6 * x[0] * x[0], 0, 0); },
      zero, zero);
  const material::Constants c = composition.in_space(0, {});
  const auto exact = [&](const Eigen::Vector3d &x) {
    Eigen::Matrix3d h = Eigen::Matrix3d::Zero();
    h(0, 0) = 2e-6 * x[0];
    return stress(c, h, Eigen::Vector3d::Zero(), 0);
  };
  EXPECT_LT(error<2>(body, recovered(body, composition, state), exact), 1e-12);
  double means = 0;
  const output::CellFields cells = derived_fields(body, composition, state);
  for (const SymmetricTensor &mean : cells.stress)
    means = std::max(means, mean[0]);
  EXPECT_LT(means, 0.9 * exact({1, 1, 0})[0]);
}

struct SineErrors {
  double inside, everywhere;
};

template <int dim>
SineErrors sine_errors(CellShape shape, int degree, int n) {
  const auto body = box<dim>(shape, degree, n);
  const material::Composition<dim> composition(asked(dim));
  const auto zero = [](const Eigen::Vector3d &) { return 0.; };
  const auto state = interpolated<dim>(
      body,
      [](const Eigen::Vector3d &x) {
        return Eigen::Vector3d(1e-6 * std::sin(2 * x[0] + x[1]), 1e-6 * std::cos(x[0] - 2 * x[1]),
                               0);
      },
      zero, zero);
  const material::Constants c = composition.in_space(0, {});
  const auto exact = [&](const Eigen::Vector3d &x) {
    Eigen::Matrix3d h = Eigen::Matrix3d::Zero();
    h(0, 0) = 2e-6 * std::cos(2 * x[0] + x[1]);
    h(0, 1) = 1e-6 * std::cos(2 * x[0] + x[1]);
    h(1, 0) = -1e-6 * std::sin(x[0] - 2 * x[1]);
    h(1, 1) = 2e-6 * std::sin(x[0] - 2 * x[1]);
    return stress(c, h, Eigen::Vector3d::Zero(), 0);
  };
  const std::vector<SymmetricTensor> found = recovered(body, composition, state);
  return {error<dim>(body, found, exact, 0.25), error<dim>(body, found, exact)};
}

template <int dim>
void expect_orders(CellShape shape, int degree, int n, double inside, double everywhere) {
  SCOPED_TRACE(::testing::Message()
               << dim << "D, shape " << static_cast<int>(shape) << ", degree " << degree);
  const SineErrors coarse = sine_errors<dim>(shape, degree, n),
                   fine = sine_errors<dim>(shape, degree, 2 * n);
  EXPECT_GT(std::log2(coarse.inside / fine.inside), inside);
  EXPECT_GT(std::log2(coarse.everywhere / fine.everywhere), everywhere);
}

// Stresses of the cells are of the order of the degree, their means of order 1 only. Quadratic
// simplices keep their order; the others gain one inside the body, tensor-product cells everywhere.
TEST(Recovery, ConvergesWithTheOrderOfTheDegreeOrOneMore) {
  expect_orders<2>(CellShape::triangle, 1, 16, 1.9, 1.8);
  expect_orders<2>(CellShape::triangle, 2, 12, 1.9, 1.9);
  expect_orders<2>(CellShape::quadrilateral, 1, 16, 1.9, 1.8);
  expect_orders<2>(CellShape::quadrilateral, 2, 12, 2.8, 2.7);
  expect_orders<3>(CellShape::tetrahedron, 1, 8, 1.8, 0.9);
  expect_orders<3>(CellShape::tetrahedron, 2, 6, 1.9, 1.9);
  expect_orders<3>(CellShape::hexahedron, 1, 8, 1.8, 1.8);
  expect_orders<3>(CellShape::hexahedron, 2, 6, 2.6, 2.5);
}

// One cell through the thickness: no corner has samples around it.
TEST(Recovery, KeepsAConstantStressInALayerOfOneCell) {
  casefile::MeshCase mesh;
  for (const CellShape shape : shapes_2d)
    for (const int degree : {1, 2}) {
      mesh.box = casefile::Box{{0, 0}, {1, 0.01}, {5, 1}, shape};
      const Discretisation<2> body(mesh::build<2>(mesh), degree);
      const material::Composition<2> composition(asked(2));
      const auto zero = [](const Eigen::Vector3d &) { return 0.; };
      const auto state = interpolated<2>(
          body,
          [](const Eigen::Vector3d &x) {
            return Eigen::Vector3d(1e-6 * x[0], -3e-6 * x[1] + 1e-6 * x[0], 0);
          },
          zero, zero);
      Eigen::Matrix3d h = Eigen::Matrix3d::Zero();
      h(0, 0) = 1e-6;
      h(1, 1) = -3e-6;
      h(1, 0) = 1e-6;
      const SymmetricTensor wanted =
          stress(composition.in_space(0, {}), h, Eigen::Vector3d::Zero(), 0);
      EXPECT_LT(error<2>(body, recovered(body, composition, state),
                         [&](const Eigen::Vector3d &) { return wanted; }),
                1e-10);
    }
}

}  // namespace
}  // namespace tourmaline::body
