// Integrals of formulas over simplices: the order in which a mesh lists a cell's corners is no
// physics.
#include "body/loads.h"

#include <gtest/gtest.h>

#include <deal.II/grid/tria.h>
#include <algorithm>
#include <array>
#include <cmath>

#include "body/fields.h"
#include "mesh/mesh.h"
#include "tourmaline/case/case.h"

namespace tourmaline::body {
namespace {

constexpr const char *density = "exp(3*x+y)*sin(5*y+2*x*x)+1/(0.1+x+y*y)";

template <int dim>
std::vector<dealii::Point<dim>> corners() {
  if constexpr (dim == 2)
    return {{0, 0}, {1, 0.1}, {0.3, 0.8}};
  else
    return {{0, 0, 0}, {1, 0.1, 0}, {0.3, 0.8, 0.1}, {0.2, 0.3, 0.9}};
}

/// Volume of the simplex with these corners, with its sign.
template <int dim>
double volume(const std::vector<dealii::Point<dim>> &points,
              const std::array<unsigned int, dim + 1> &order) {
  dealii::Tensor<2, dim> edges;
  for (int i = 0; i < dim; ++i)
    edges[i] = points[order[i + 1]] - points[order[0]];
  return dealii::determinant(edges);
}

/// Loads of one simplex with the corners in this order: a force and a heat in its volume, a
/// traction on all of its boundary.
template <int dim>
std::vector<double> loads(const std::array<unsigned int, dim + 1> &order, int degree) {
  dealii::CellData<dim> cell(dim + 1);
  std::copy(order.begin(), order.end(), cell.vertices.begin());
  mesh::Mesh<dim> mesh;
  mesh.cells = std::make_unique<dealii::Triangulation<dim>>();
  mesh.cells->create_triangulation(corners<dim>(), {cell}, {});
  mesh.simplices = true;
  mesh.boundaries["skin"] = {0};
  casefile::Case asked;
  asked.dimension = dim;
  asked.load.force.assign(dim, casefile::Formula(density));
  asked.load.heat = casefile::Formula(density);
  casefile::BoundaryCase skin;
  skin.on = {"skin"};
  skin.traction = casefile::FormulaVector(dim, casefile::Formula(density));
  asked.boundaries.push_back(skin);
  const Discretisation<dim> body(mesh, degree);
  const Loads<dim> all(body, asked, 1, 300);
  std::vector<double> right_side(body.n_nodes() * Fields<dim>::count, 0.);
  all.integrate(1, right_side);
  return right_side;
}

template <int dim>
void expect_no_difference(int degree) {
  std::array<unsigned int, dim + 1> order;
  for (int i = 0; i <= dim; ++i)
    order[i] = i;
  const std::vector<double> expected = loads<dim>(order, degree);
  double size = 0;
  for (const double load : expected)
    size = std::max(size, std::abs(load));
  int compared = 0;
  while (std::next_permutation(order.begin(), order.end())) {
    if (volume<dim>(corners<dim>(), order) < 0)
      continue;
    ++compared;
    const std::vector<double> found = loads<dim>(order, degree);
    for (std::size_t i = 0; i < expected.size(); ++i)
      EXPECT_NEAR(found[i], expected[i], 1e-13 * size) << i;
  }
  EXPECT_EQ(compared, dim == 2 ? 2 : 11);
}

TEST(Loads, OrderOfATrianglesCornersChangesNone) {
  expect_no_difference<2>(1);
  expect_no_difference<2>(2);
}

TEST(Loads, OrderOfATetrahedronsCornersChangesNone) {
  expect_no_difference<3>(1);
  expect_no_difference<3>(2);
}

}  // namespace
}  // namespace tourmaline::body
