#include "mesh/grading.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "mesh/mesh.h"
#include "tourmaline/case/case.h"

namespace tourmaline::mesh {
namespace {

std::vector<double> sizes(const std::vector<double> &line) {
  std::vector<double> all;
  for (std::size_t i = 1; i < line.size(); ++i)
    all.push_back(line[i] - line[i - 1]);
  return all;
}

TEST(GradedLine, WithoutGradingAllCellsAreEqual) {
  for (const double size : sizes(graded_line(-1, 3, 8, 1, 1)))
    EXPECT_DOUBLE_EQ(size, 0.5);
}

TEST(GradedLine, EndsAtTheCornersToTheLastBit) {
  const std::vector<double> line = graded_line(0.1, 0.3, 7, 5, 3);
  EXPECT_EQ(line.front(), 0.1);
  EXPECT_EQ(line.back(), 0.3);
}

// One-sided the map is x = 1 - erf(a (1 - s))/erf(a) with a = sqrt(ln 16).
TEST(GradedLine, FirstAndLastCellAreThoseOfTheMapByHand) {
  const double a = std::sqrt(std::log(16.));
  const std::vector<double> all = sizes(graded_line(0, 1, 20, 16, 1));
  EXPECT_NEAR(all.front(), 1 - std::erf(a * 0.95) / std::erf(a), 1e-15);
  EXPECT_NEAR(all.back(), std::erf(a * 0.05) / std::erf(a), 1e-15);
}

TEST(GradedLine, TheNumberIsTheRatioOfTheLargestToTheOutermostCellAsTheCellsGrowMany) {
  double before = 1;
  for (const int cells : {20, 40, 80, 160}) {
    const std::vector<double> all = sizes(graded_line(0, 1, cells, 16, 1));
    const double off = 1 - all.back() / all.front() / 16;
    EXPECT_GT(off, 0);
    EXPECT_LT(off, 0.6 * before);
    before = off;
  }
  EXPECT_LT(before, 0.02);
}

TEST(GradedLine, BothEndsHaveTheirOwnRatioToTheLargestCellBetweenThem) {
  const std::vector<double> all = sizes(graded_line(0, 1, 2000, 10, 3));
  const double most = *std::max_element(all.begin(), all.end());
  EXPECT_NEAR(most / all.front(), 10, 0.05);
  EXPECT_NEAR(most / all.back(), 3, 0.01);
  EXPECT_LT(all.front(), all[1000]);
  EXPECT_LT(all.back(), all[1000]);
}

TEST(GradedLine, MirroredRatiosMirrorTheLine) {
  const std::vector<double> one = graded_line(0, 1, 11, 9, 2), other = graded_line(0, 1, 11, 2, 9);
  for (std::size_t i = 0; i < one.size(); ++i)
    EXPECT_NEAR(one[i], 1 - other[one.size() - 1 - i], 1e-15);
}

TEST(GradedLine, TwiceAsManyCellsKeepEveryVertex) {
  const std::vector<double> coarse = graded_line(0, 0.1, 12, 8, 2),
                            fine = graded_line(0, 0.1, 24, 8, 2);
  for (std::size_t i = 0; i < coarse.size(); ++i)
    EXPECT_DOUBLE_EQ(coarse[i], fine[2 * i]);
}

// The logarithm of the size is a parabola in s, steepest at the ends: 2 a (a + b).
TEST(GradedLine, NeighbouringCellsDifferByNoMoreThanTheSteepestSlope) {
  const double a = std::sqrt(std::log(100.)), b = std::sqrt(std::log(10.));
  const std::vector<double> all = sizes(graded_line(0, 1, 64, 100, 10));
  for (std::size_t i = 1; i < all.size(); ++i)
    EXPECT_LT(std::abs(std::log(all[i] / all[i - 1])), 2 * a * (a + b) / 64);
}

casefile::MeshCase box(casefile::CellShape cell, std::map<std::string, double> grading) {
  casefile::MeshCase asked;
  const bool flat = casefile::dimension_of(cell) == 2;
  asked.box = flat ? casefile::Box{{0, 1}, {2, 2}, {4, 3}, cell, std::move(grading)}
                   : casefile::Box{{0, 1, 0}, {2, 2, 1}, {4, 3, 2}, cell, std::move(grading)};
  return asked;
}

template <int dim>
std::set<double> coordinates(const Mesh<dim> &mesh, int axis) {
  std::set<double> all;
  for (const auto &vertex : mesh.cells->get_vertices())
    all.insert(vertex[axis]);
  return all;
}

template <int dim>
void expect_same_topology(casefile::CellShape shape, const std::map<std::string, double> &grading) {
  const Mesh<dim> plain = build<dim>(box(shape, {})), graded = build<dim>(box(shape, grading));
  ASSERT_EQ(plain.cells->n_active_cells(), graded.cells->n_active_cells());
  auto other = graded.cells->begin_active();
  double volume = 0;
  for (const auto &cell : plain.cells->active_cell_iterators()) {
    for (const unsigned int v : cell->vertex_indices())
      EXPECT_EQ(cell->vertex_index(v), other->vertex_index(v));
    for (const unsigned int f : cell->face_indices())
      EXPECT_EQ(cell->face(f)->boundary_id(), other->face(f)->boundary_id());
    volume += other->measure();
    ++other;
  }
  EXPECT_NEAR(volume, 2, 1e-12);
}

TEST(GradedBox, KeepsTopologyBoundariesAndVolumeOnEveryShapeOfCell) {
  const std::map<std::string, double> grading{{"left", 4}, {"top", 3}, {"bottom", 2}};
  expect_same_topology<2>(casefile::CellShape::triangle, grading);
  expect_same_topology<2>(casefile::CellShape::quadrilateral, grading);
  expect_same_topology<3>(casefile::CellShape::tetrahedron, grading);
  expect_same_topology<3>(casefile::CellShape::hexahedron, grading);
}

TEST(GradedBox, ANamedSideGradesItsAxisOnly) {
  const Mesh<2> mesh = build<2>(box(casefile::CellShape::triangle, {{"top", 4}}));
  EXPECT_EQ(coordinates(mesh, 0), (std::set<double>{0, 0.5, 1, 1.5, 2}));
  const std::vector<double> line = graded_line(1, 2, 3, 1, 4);
  EXPECT_EQ(coordinates(mesh, 1), std::set<double>(line.begin(), line.end()));
}

TEST(GradedBox, InThreeDimensionsTopIsTheEndOfTheThirdAxisAndBackThatOfTheSecond) {
  const Mesh<3> mesh = build<3>(box(casefile::CellShape::tetrahedron, {{"top", 4}, {"back", 2}}));
  const std::vector<double> y = graded_line(1, 2, 3, 1, 2), z = graded_line(0, 1, 2, 1, 4);
  EXPECT_EQ(coordinates(mesh, 1), std::set<double>(y.begin(), y.end()));
  EXPECT_EQ(coordinates(mesh, 2), std::set<double>(z.begin(), z.end()));
}

}  // namespace
}  // namespace tourmaline::mesh
