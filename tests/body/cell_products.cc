#include "body/cell_products.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "mesh/mesh.h"
#include "tourmaline/case/case.h"

namespace tourmaline::body {
namespace {

using casefile::CellShape;

template <int dim>
casefile::Case asked(CellShape shape, std::vector<double> size, const char *plane) {
  casefile::Case asked;
  asked.dimension = dim;
  asked.model.plane = plane;
  asked.material.library = "BaTiO3-Liu2014";
  asked.mesh.box =
      casefile::Box{std::vector<double>(dim, 0.), std::move(size), std::vector<int>(dim, 3), shape};
  return asked;
}

template <int dim>
struct Body {
  Body(CellShape shape, int degree, std::vector<double> size, Modes modes = Modes::none,
       const char *plane = "strain")
      : of(asked<dim>(shape, std::move(size), plane)),
        composition(of),
        body(mesh::build<dim>(of), degree, geometry_of(of)),
        op(body, composition, modes),
        cells(body, composition, op.modes()) {}

  std::size_t n() const { return body.n_nodes() * Fields<dim>::count; }

  casefile::Case of;
  material::Composition<dim> composition;
  Discretisation<dim> body;
  Operator<dim> op;
  CellProducts<dim> cells;
};

double largest(const std::vector<double> &v) {
  double largest = 0;
  for (const double x : v)
    largest = std::max(largest, std::abs(x));
  return largest;
}

template <int dim>
void expect_products_of_the_operator(CellShape shape, int degree, Modes modes = Modes::none,
                                     const char *plane = "strain") {
  Body<dim> of(shape, degree, std::vector<double>(dim, 0.1), modes, plane);
  const casefile::Formula coefficient(3.);
  of.op.add_exchange(of.body, {"left"}, coefficient);
  of.cells.add_exchange({"left"}, coefficient);
  std::mt19937 random(5);
  std::vector<double> x(of.n()), expected(of.n()), found(of.n());
  for (double &v : x)
    v = std::normal_distribution<double>()(random);
  of.op.multiply(0.01, x, expected);
  of.cells.multiply(0.01, x, found);
  const std::vector<double> sizes = of.op.sizes(0.01, x);
  for (std::size_t i = 0; i < x.size(); ++i)
    EXPECT_NEAR(found[i], expected[i], 1e-13 * sizes[i]) << i;
  FieldProducts of_operator, of_cells;
  of.op.multiply_by_field(x, of_operator);
  of.cells.multiply_by_field(x, of_cells);
  for (int field = 0; field < 3; ++field)
    for (std::size_t i = 0; i < x.size(); ++i)
      EXPECT_NEAR(of_operator.of[field][i], of_cells.of[field][i], 1e-13 * sizes[i]) << i;
}

TEST(CellProducts, TheyAreThoseOfTheOperator) {
  for (const int degree : {1, 2}) {
    expect_products_of_the_operator<2>(CellShape::triangle, degree);
    expect_products_of_the_operator<2>(CellShape::quadrilateral, degree);
    expect_products_of_the_operator<3>(CellShape::tetrahedron, degree);
    expect_products_of_the_operator<3>(CellShape::hexahedron, degree);
  }
}

TEST(CellProducts, IncompatibleModesAreInThem) {
  expect_products_of_the_operator<2>(CellShape::quadrilateral, 1, Modes::incompatible);
  expect_products_of_the_operator<3>(CellShape::hexahedron, 1, Modes::incompatible);
}

TEST(CellProducts, OfARevolvedBodyTheyHaveTheHoopStress) {
  const char *plane = "axisymmetric";
  for (const int degree : {1, 2}) {
    expect_products_of_the_operator<2>(CellShape::triangle, degree, Modes::none, plane);
    expect_products_of_the_operator<2>(CellShape::quadrilateral, degree, Modes::none, plane);
  }
  expect_products_of_the_operator<2>(CellShape::quadrilateral, 1, Modes::incompatible, plane);
}

TEST(CellProducts, ATranslationOfAThinBodyHasNoForcesAtAll) {
  const Body<2> of(CellShape::quadrilateral, 2, {1, 1e-4});
  std::vector<double> x(of.n(), 0.), cells(of.n()), assembled(of.n());
  for (Node node = 0; node < of.body.n_nodes(); ++node)
    x[unknown<2>(node, 1)] = 0.3;
  of.cells.multiply(0.01, x, cells);
  of.op.multiply(0.01, x, assembled);
  EXPECT_EQ(largest(cells), 0);
  EXPECT_GT(largest(assembled), 0);
}

TEST(CellProducts, AConstantPotentialHasNoChargesOfTheOperatorByFieldEither) {
  const Body<2> of(CellShape::triangle, 2, {1, 1e-4});
  std::vector<double> x(of.n(), 0.);
  for (Node node = 0; node < of.body.n_nodes(); ++node)
    x[unknown<2>(node, Fields<2>::potential)] = 0.3;
  FieldProducts by_field;
  of.op.multiply_by_field(x, by_field);
  for (const std::vector<double> &product : by_field.of)
    EXPECT_EQ(largest(product), 0);
  std::vector<double> summed(of.n());
  of.op.multiply(0.01, x, summed);
  EXPECT_GT(largest(summed), 0);
}

}  // namespace
}  // namespace tourmaline::body
