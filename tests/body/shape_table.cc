// Tabulated shape functions and facets against deal.II's FEValues and FEFaceValues, on cells whose
// sides are not parallel and that lie far from the origin.
#include "body/shape_table.h"

#include <gtest/gtest.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_fe.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria.h>
#include <algorithm>
#include <cmath>
#include <memory>

#include "body/reference_facet.h"

namespace tourmaline::body {
namespace {

constexpr double few_digits = 1e-13;

template <int dim>
struct OneCell {
  OneCell(bool simplex, int degree)
      : element(lagrange(simplex, degree)),
        linear(lagrange(simplex, 1)),
        mapping(*linear),
        rule(simplex ? dealii::Quadrature<dim>(dealii::QWitherdenVincentSimplex<dim>(degree + 1))
                     : dealii::Quadrature<dim>(dealii::QGauss<dim>(degree + 1))),
        facet_rule(
            simplex && dim == 3
                ? dealii::Quadrature<dim - 1>(dealii::QWitherdenVincentSimplex<dim - 1>(degree + 1))
                : dealii::Quadrature<dim - 1>(dealii::QGauss<dim - 1>(degree + 1))) {
    dealii::GridGenerator::reference_cell(cells, element->reference_cell());
    dealii::GridTools::transform(
        [](const dealii::Point<dim> &p) {
          dealii::Point<dim> q;
          for (unsigned int i = 0; i < dim; ++i)
            q[i] = 20. + 0.3 * i + (1 + 0.2 * i) * p[i] + 0.15 * p[(i + 1) % dim] +
                   0.1 * p[0] * p[1] * (i + 1.);
          return q;
        },
        cells);
    const auto cell = cells.begin_active();
    for (const unsigned int v : cell->vertex_indices()) {
      corners.push_back({});
      for (unsigned int i = 0; i < dim; ++i)
        corners.back()[i] = cell->vertex(v)[i];
    }
    nodes.resize(element->n_dofs_per_cell());
  }

  static std::unique_ptr<dealii::FiniteElement<dim>> lagrange(bool simplex, int degree) {
    if (simplex)
      return std::make_unique<dealii::FE_SimplexP<dim>>(degree);
    return std::make_unique<dealii::FE_Q<dim>>(degree);
  }

  std::unique_ptr<dealii::FiniteElement<dim>> element, linear;
  dealii::MappingFE<dim> mapping;
  dealii::Quadrature<dim> rule;
  dealii::Quadrature<dim - 1> facet_rule;
  dealii::Triangulation<dim> cells;
  std::vector<Vector3> corners;
  std::vector<Node> nodes;
};

const auto wanted = dealii::update_values | dealii::update_gradients | dealii::update_JxW_values |
                    dealii::update_quadrature_points;

template <int dim, class Values>
void expect_alike(const Values &expected, const Quadrature<dim> &found) {
  ASSERT_EQ(found.jxw.size(), expected.n_quadrature_points);
  for (unsigned int q = 0; q < expected.n_quadrature_points; ++q) {
    EXPECT_NEAR(found.jxw[q], expected.JxW(q), few_digits);
    for (unsigned int i = 0; i < dim; ++i)
      EXPECT_NEAR(found.points[q][i], expected.quadrature_point(q)[i], 20 * few_digits);
    for (unsigned int a = 0; a < found.nodes.size(); ++a)
      EXPECT_NEAR(found.value(q, a), expected.shape_value(a, q), few_digits);
  }
}

template <int dim>
void expect_cell(bool simplex, int degree) {
  OneCell<dim> one(simplex, degree);
  dealii::FEValues<dim> expected(one.mapping, *one.element, one.rule, wanted);
  expected.reinit(one.cells.begin_active());
  Quadrature<dim> found;
  found.nodes = one.nodes;
  ShapeTable<dim>(*one.element, *one.linear, one.rule).fill_cell(one.corners, found);
  expect_alike(expected, found);
  for (unsigned int q = 0; q < expected.n_quadrature_points; ++q)
    for (unsigned int a = 0; a < found.nodes.size(); ++a)
      for (unsigned int i = 0; i < dim; ++i)
        EXPECT_NEAR(found.gradient(q, a)[i], expected.shape_grad(a, q)[i], 1e-11);
}

TEST(ShapeTable, CellsAreThoseOfFEValues) {
  for (const bool simplex : {false, true})
    for (const int degree : {1, 2}) {
      SCOPED_TRACE(testing::Message() << (simplex ? "simplex" : "box") << " of degree " << degree);
      expect_cell<2>(simplex, degree);
      expect_cell<3>(simplex, degree);
    }
}

// The points of a facet may come in another order, so integrals are compared, of each shape
// function times its square and of the normal.
template <int dim>
void expect_facets(bool simplex, int degree) {
  OneCell<dim> one(simplex, degree);
  dealii::FEFaceValues<dim> expected(one.mapping, *one.element, one.facet_rule,
                                     wanted | dealii::update_normal_vectors);
  const auto facets = facets_of(*one.element, *one.linear, one.facet_rule);
  ASSERT_EQ(facets.size(), one.cells.begin_active()->n_faces());
  for (unsigned int f = 0; f < facets.size(); ++f) {
    SCOPED_TRACE(testing::Message() << "facet " << f);
    expected.reinit(one.cells.begin_active(), f);
    Quadrature<dim> found;
    found.nodes = one.nodes;
    facets[f].shapes.fill_facet(one.corners, facets[f].tangents, found);
    for (unsigned int a = 0; a < one.nodes.size(); ++a)
      for (unsigned int i = 0; i < dim; ++i) {
        double ours = 0, theirs = 0;
        for (unsigned int q = 0; q < expected.n_quadrature_points; ++q) {
          ours += found.jxw[q] * std::pow(found.value(q, a), 2) * found.normals[q][i];
          theirs += expected.JxW(q) * std::pow(expected.shape_value(a, q), 2) *
                    expected.normal_vector(q)[i];
        }
        EXPECT_NEAR(ours, theirs, few_digits);
      }
  }
}

TEST(ReferenceFacet, FacetsAreThoseOfFEFaceValues) {
  for (const bool simplex : {false, true})
    for (const int degree : {1, 2}) {
      SCOPED_TRACE(testing::Message() << (simplex ? "simplex" : "box") << " of degree " << degree);
      expect_facets<2>(simplex, degree);
      expect_facets<3>(simplex, degree);
    }
}

// Nodes of a facet are those whose shape function does not vanish on it.
template <int dim>
void expect_nodes(bool simplex, int degree) {
  const OneCell<dim> one(simplex, degree);
  for (const ReferenceFacet<dim> &facet : facets_of(*one.element, *one.linear, one.facet_rule)) {
    Quadrature<dim> found;
    found.nodes = one.nodes;
    facet.shapes.fill_facet(one.corners, facet.tangents, found);
    for (unsigned int a = 0; a < one.nodes.size(); ++a) {
      double largest = 0;
      for (std::size_t q = 0; q < found.jxw.size(); ++q)
        largest = std::max(largest, std::abs(found.value(q, a)));
      EXPECT_EQ(std::count(facet.nodes.begin(), facet.nodes.end(), a), largest > 1e-9 ? 1 : 0);
    }
    EXPECT_EQ(facet.corners.size(), dim == 2 ? 2U : simplex ? 3U : 4U);
  }
}

TEST(ReferenceFacet, HasTheNodesThatReachIt) {
  for (const bool simplex : {false, true})
    for (const int degree : {1, 2}) {
      expect_nodes<2>(simplex, degree);
      expect_nodes<3>(simplex, degree);
    }
}

}  // namespace
}  // namespace tourmaline::body
