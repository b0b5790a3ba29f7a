#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "mesh/mesh.h"
#include "tourmaline/case/case.h"

namespace tourmaline::mesh {
namespace {

using casefile::CellShape;

constexpr double inner = 0.3, outer = 0.7, height = 0.5;

template <int dim>
Mesh<dim> ring(CellShape shape, std::vector<int> cells) {
  casefile::MeshCase asked;
  asked.annulus = casefile::Annulus{inner, outer, dim == 3 ? height : 0, std::move(cells), shape};
  return build<dim>(asked);
}

// Of a regular polygon with n corners on the circle.
double polygon_area(double radius, int n) {
  return n * radius * radius / 2 * std::sin(2 * std::numbers::pi / n);
}
double polygon_length(double radius, int n) {
  return 2 * n * radius * std::sin(std::numbers::pi / n);
}

template <int dim>
double volume(const Mesh<dim> &mesh) {
  double sum = 0;
  for (const auto &cell : mesh.cells->active_cell_iterators()) {
    EXPECT_GT(cell->measure(), 0);
    sum += cell->measure();
  }
  return sum;
}

// By the names of the sides; every facet on the boundary has one.
template <int dim>
std::map<std::string, double> sizes_of_sides(const Mesh<dim> &mesh) {
  std::map<std::string, double> sizes;
  for (const auto &cell : mesh.cells->active_cell_iterators())
    for (const unsigned int f : cell->face_indices())
      if (cell->face(f)->at_boundary()) {
        int named = 0;
        for (const auto &[name, ids] : mesh.boundaries)
          if (ids.contains(cell->face(f)->boundary_id())) {
            sizes[name] += cell->face(f)->measure();
            ++named;
          }
        EXPECT_EQ(named, 1);
      }
  return sizes;
}

TEST(Annulus, IsTheRingBetweenTwoPolygonsOnEveryShapeOfCell) {
  constexpr int n = 10;
  for (const CellShape shape : {CellShape::triangle, CellShape::quadrilateral}) {
    const Mesh<2> mesh = ring<2>(shape, {3, n});
    EXPECT_EQ(mesh.cells->n_active_cells(), shape == CellShape::triangle ? 60u : 30u);
    EXPECT_NEAR(volume(mesh), polygon_area(outer, n) - polygon_area(inner, n), 1e-14);
    const auto sides = sizes_of_sides(mesh);
    EXPECT_NEAR(sides.at("inner"), polygon_length(inner, n), 1e-14);
    EXPECT_NEAR(sides.at("outer"), polygon_length(outer, n), 1e-14);
  }
}

TEST(Annulus, InThreeDimensionsItIsATubeWithBottomAndTop) {
  constexpr int n = 9;  // odd: tetrahedra must fit where the ends of the bent box meet
  for (const CellShape shape : {CellShape::tetrahedron, CellShape::hexahedron}) {
    const Mesh<3> mesh = ring<3>(shape, {2, n, 3});
    EXPECT_EQ(mesh.cells->n_active_cells(), shape == CellShape::tetrahedron ? 324u : 54u);
    const double face = polygon_area(outer, n) - polygon_area(inner, n);
    EXPECT_NEAR(volume(mesh), height * face, 1e-14);
    const auto sides = sizes_of_sides(mesh);
    EXPECT_NEAR(sides.at("inner"), height * polygon_length(inner, n), 1e-14);
    EXPECT_NEAR(sides.at("outer"), height * polygon_length(outer, n), 1e-14);
    EXPECT_NEAR(sides.at("bottom"), face, 1e-14);
    EXPECT_NEAR(sides.at("top"), face, 1e-14);
  }
}

TEST(Annulus, ATubeStandsOnZIsZero) {
  const Mesh<3> mesh = ring<3>(CellShape::hexahedron, {1, 8, 1});
  for (const auto &cell : mesh.cells->active_cell_iterators())
    for (const unsigned int f : cell->face_indices())
      if (cell->face(f)->at_boundary() &&
          mesh.boundaries.at("bottom").contains(cell->face(f)->boundary_id())) {
        EXPECT_EQ(cell->face(f)->center()[2], 0);
      }
}

TEST(Annulus, CornersOfCellsLieOnCircles) {
  const Mesh<2> mesh = ring<2>(CellShape::triangle, {2, 11});
  for (const dealii::Point<2> &p : mesh.cells->get_vertices()) {
    const double radius = p.norm();
    EXPECT_LT(
        std::min({std::abs(radius - inner), std::abs(radius - 0.5), std::abs(radius - outer)}),
        1e-15);
  }
}

}  // namespace
}  // namespace tourmaline::mesh
