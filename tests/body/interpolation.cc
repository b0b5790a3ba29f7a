// The fields at places of the body: as exact as the shape functions, on every cell.
#include "body/interpolation.h"

#include <gtest/gtest.h>

#include <random>

#include "mesh/mesh.h"
#include "tourmaline/case/case.h"

namespace tourmaline::body {
namespace {

using casefile::CellShape;

struct Cells {
  CellShape shape;
  int degree;
};

class Places : public testing::TestWithParam<Cells> {
 protected:
  static int dimension() {
    const CellShape shape = GetParam().shape;
    return shape == CellShape::triangle || shape == CellShape::quadrilateral ? 2 : 3;
  }
};

// Cells of a ring or tube are no parallelograms, so their maps are not affine.
template <int dim>
Discretisation<dim> ring(const Cells &cells) {
  const std::vector<int> counts = dim == 2 ? std::vector{2, 12} : std::vector{2, 12, 2};
  casefile::MeshCase mesh;
  mesh.annulus.emplace(casefile::Annulus{0.1, 0.2, dim == 3 ? 0.3 : 0, counts, cells.shape});
  return {mesh::build<dim>(mesh), cells.degree};
}

// A polynomial of the degree, with every product that it may have.
double polynomial(const Vector3 &x, int degree) {
  const double linear = 2 - 3 * x[0] + 5 * x[1] - 7 * x[2];
  return degree == 1 ? linear
                     : linear + 11 * x[0] * x[0] - 13 * x[0] * x[1] + 17 * x[1] * x[1] -
                           19 * x[1] * x[2] + 23 * x[2] * x[2];
}

template <int dim>
std::vector<double> interpolated(const Discretisation<dim> &body, int degree) {
  std::vector<double> state(body.n_nodes() * Fields<dim>::count);
  for (Node i = 0; i < body.n_nodes(); ++i)
    for (int c = 0; c < Fields<dim>::count; ++c)
      state[unknown<dim>(i, c)] = (c + 1) * polynomial(body.points()[i], degree);
  return state;
}

// Points between the circles, away from the straight sides of the cells.
template <int dim>
std::vector<Vector3> random_places(int n) {
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> radius(0.11, 0.19), angle(0, 6.28), height(0, 0.3);
  std::vector<Vector3> places;
  for (int i = 0; i < n; ++i) {
    const double r = radius(generator), a = angle(generator);
    places.push_back({r * std::cos(a), r * std::sin(a), dim == 3 ? height(generator) : 0});
  }
  return places;
}

template <int dim>
void expect_exact(const Discretisation<dim> &body, const std::vector<Vector3> &places, int degree) {
  const std::vector<double> state = interpolated(body, degree);
  const std::vector<Interpolation> found = nearest_places(body, places);
  ASSERT_EQ(found.size(), places.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    ASSERT_EQ(found[i].distance, 0);
    for (int c = 0; c < Fields<dim>::count; ++c)
      EXPECT_NEAR(found[i].template value<dim>(state, c), (c + 1) * polynomial(places[i], degree),
                  1e-12);
  }
}

template <int dim>
void expect_exact(const Cells &cells) {
  const Discretisation<dim> body = ring<dim>(cells);
  // Where cells are no simplices, their maps take from degree 2 no products of x and y but those of
  // degree 1: the space holds all polynomials of degree 1, and on simplices those of degree 2.
  expect_exact(body, random_places<dim>(200), body.has_simplices() ? cells.degree : 1);
}

TEST_P(Places, APolynomialOfTheDegreeIsExact) {
  if (dimension() == 2)
    expect_exact<2>(GetParam());
  else
    expect_exact<3>(GetParam());
}

template <int dim>
void expect_nodal_values(const Cells &cells) {
  const Discretisation<dim> body = ring<dim>(cells);
  expect_exact(body, body.points(), 1);
}

TEST_P(Places, AtANodeTheFieldsAreItsOwn) {
  if (dimension() == 2)
    expect_nodal_values<2>(GetParam());
  else
    expect_nodal_values<3>(GetParam());
}

INSTANTIATE_TEST_SUITE_P(
    Cells, Places,
    testing::Values(Cells{CellShape::triangle, 1}, Cells{CellShape::triangle, 2},
                    Cells{CellShape::quadrilateral, 1}, Cells{CellShape::quadrilateral, 2},
                    Cells{CellShape::tetrahedron, 1}, Cells{CellShape::tetrahedron, 2},
                    Cells{CellShape::hexahedron, 1}, Cells{CellShape::hexahedron, 2}));

template <int dim>
Discretisation<dim> box(CellShape shape, int degree) {
  casefile::MeshCase mesh;
  mesh.box = casefile::Box{std::vector<double>(dim, 0.), std::vector<double>(dim, 2.),
                           std::vector<int>(dim, 3), shape};
  return {mesh::build<dim>(mesh), degree};
}

TEST(QuadraticBoxes, HoldEveryPolynomialOfDegreeTwo) {
  const std::vector<Vector3> plane{{0.1, 1.3, 0}, {1.99, 0.01, 0}, {0.7, 0.7, 0}},
      space{{0.1, 1.3, 0.4}, {1.99, 0.01, 2}, {0.7, 0.7, 1.1}};
  expect_exact(box<2>(CellShape::quadrilateral, 2), plane, 2);
  expect_exact(box<3>(CellShape::hexahedron, 2), space, 2);
}

template <int dim>
void expect_nearest(CellShape shape, const Vector3 &outside, const Vector3 &nearest) {
  const Discretisation<dim> body = box<dim>(shape, 1);
  const Interpolation found = nearest_places(body, {outside}).front();
  double square = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(found.place[axis], nearest[axis], 1e-14);
    square += std::pow(outside[axis] - nearest[axis], 2);
  }
  EXPECT_NEAR(found.distance, std::sqrt(square), 1e-14);
  EXPECT_TRUE(found.nodes.empty());
}

TEST(APlaceOutside, HasANearestOneInTheBody) {
  for (const CellShape shape : {CellShape::triangle, CellShape::quadrilateral}) {
    expect_nearest<2>(shape, {2.5, 0.9, 0}, {2, 0.9, 0});
    expect_nearest<2>(shape, {-1, 3, 0}, {0, 2, 0});
    expect_nearest<2>(shape, {1.1, -1e-6, 0}, {1.1, 0, 0});
  }
  for (const CellShape shape : {CellShape::tetrahedron, CellShape::hexahedron}) {
    expect_nearest<3>(shape, {2.5, 0.9, 1.7}, {2, 0.9, 1.7});
    expect_nearest<3>(shape, {-1, 3, 0.2}, {0, 2, 0.2});
    expect_nearest<3>(shape, {-1, 3, 7}, {0, 2, 2});
  }
}

TEST(APlaceOnTheBoundary, MayBeOffItByRoundOff) {
  const Discretisation<2> body = box<2>(CellShape::triangle, 1);
  const Interpolation found = nearest_places(body, {{2 + 1e-10, 0.9, 0}}).front();
  EXPECT_EQ(found.distance, 0);
  EXPECT_EQ(found.nodes.size(), 3u);
}

}  // namespace
}  // namespace tourmaline::body
