#include "mesh/completed.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "tourmaline/error.h"

namespace tourmaline::mesh {
namespace {

using casefile::CellShape;
using casefile::MeshFile;
using testing::HasSubstr;
using Cells = std::vector<std::vector<std::uint32_t>>;

MeshFile of(CellShape shape, std::vector<std::array<double, 3>> points, const Cells &cells) {
  MeshFile mesh;
  mesh.dimension = shape == CellShape::triangle || shape == CellShape::quadrilateral ? 2 : 3;
  mesh.cell = shape;
  mesh.points = std::move(points);
  for (const auto &cell : cells)
    mesh.cells.insert(mesh.cells.end(), cell.begin(), cell.end());
  mesh.regions.set_of.assign(cells.size(), 0);
  return mesh;
}

std::string complaint(const MeshFile &mesh) {
  try {
    completed(mesh);
  } catch (const CaseError &error) {
    return error.what();
  }
  return "";
}

// A square or cube of side n, in unit cells in Gmsh's numbering; simplices walk along the axes in
// every order, so that half of them are listed inside out.
MeshFile block(CellShape shape, std::uint32_t n) {
  const bool plane = shape == CellShape::triangle || shape == CellShape::quadrilateral;
  const std::uint32_t layers = plane ? 1 : n;
  const auto vertex = [&](std::uint32_t i, std::uint32_t j, std::uint32_t k) {
    return i + (n + 1) * (j + (n + 1) * k);
  };
  std::vector<std::array<double, 3>> points;
  for (std::uint32_t k = 0; k <= (plane ? 0 : n); ++k)
    for (std::uint32_t j = 0; j <= n; ++j)
      for (std::uint32_t i = 0; i <= n; ++i)
        points.push_back({1. * i, 1. * j, 1. * k});
  Cells cells;
  const auto add = [&](std::uint32_t i, std::uint32_t j, std::uint32_t k) {
    const std::vector<std::uint32_t> low{vertex(i, j, k), vertex(i + 1, j, k),
                                         vertex(i + 1, j + 1, k), vertex(i, j + 1, k)};
    std::vector<std::uint32_t> all = low;
    for (const std::uint32_t v : low)
      all.push_back(v + (n + 1) * (n + 1));
    if (shape == CellShape::quadrilateral)
      return cells.push_back(low);
    if (shape == CellShape::hexahedron)
      return cells.push_back(all);
    std::array<std::uint32_t, 3> steps{1, n + 1, (n + 1) * (n + 1)};
    const auto end = steps.begin() + (plane ? 2 : 3);
    do {
      std::vector<std::uint32_t> cell{vertex(i, j, k)};
      for (auto step = steps.begin(); step != end; ++step)
        cell.push_back(cell.back() + *step);
      cells.push_back(cell);
    } while (std::next_permutation(steps.begin(), end));
  };
  for (std::uint32_t k = 0; k < layers; ++k)
    for (std::uint32_t j = 0; j < n; ++j)
      for (std::uint32_t i = 0; i < n; ++i)
        add(i, j, k);
  return of(shape, points, cells);
}

using Point = std::array<double, 3>;

double determinant(const Point &o, const Point &a, const Point &b, const Point &c) {
  Point u, v, w;
  for (int i = 0; i < 3; ++i) {
    u[i] = a[i] - o[i];
    v[i] = b[i] - o[i];
    w[i] = c[i] - o[i];
  }
  return u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0]) +
         u[2] * (v[0] * w[1] - v[1] * w[0]);
}

// Sum of the sizes of simplices, whatever their order: more than the body's where they overlap.
double total(const MeshFile &mesh) {
  double sum = 0;
  const std::size_t each = mesh.vertices_per_cell();
  for (std::size_t cell = 0; cell < mesh.n_cells(); ++cell) {
    const auto p = [&](std::size_t i) { return mesh.points[mesh.cells[cell * each + i]]; };
    const Point up{p(0)[0], p(0)[1], 1};
    sum += each == 3 ? std::abs(determinant(p(0), p(1), p(2), up)) / 2
                     : std::abs(determinant(p(0), p(1), p(2), p(3))) / 6;
  }
  return sum;
}

class EveryShape : public testing::TestWithParam<CellShape> {};
INSTANTIATE_TEST_SUITE_P(Completed, EveryShape,
                         testing::Values(CellShape::triangle, CellShape::quadrilateral,
                                         CellShape::tetrahedron, CellShape::hexahedron));

// The cells around a vertex fill a body with the same boundary wherever that vertex is: their sizes
// add up to that body's exactly when none is turned over. Cells of other shapes must be convex too.
TEST_P(EveryShape, AMovedInnerVertexIsRefusedExactlyWhenItFoldsTheMesh) {
  const MeshFile good = block(GetParam(), 3);
  const bool simplices = GetParam() == CellShape::triangle || GetParam() == CellShape::tetrahedron;
  const double size = good.dimension == 2 ? 9 : 27;
  ASSERT_EQ(complaint(good), "");
  std::mt19937 random(1);
  std::uniform_real_distribution<double> shift(-1.6, 1.6);
  int refused = 0, accepted = 0;
  for (int trial = 0; trial < 300; ++trial) {
    MeshFile mesh = good;
    const std::uint32_t inner = 1 + 4 * (1 + (good.dimension == 3 ? 4 : 0));
    for (int axis = 0; axis < good.dimension; ++axis)
      mesh.points[inner][axis] += shift(random) * (trial % 3 == 0 ? 0.2 : 1);
    const std::string text = complaint(mesh);
    (text.empty() ? accepted : refused) += 1;
    if (simplices) {
      EXPECT_EQ(text.empty(), total(mesh) < size * (1 + 1e-12)) << text;
    } else if (!text.empty()) {
      EXPECT_THAT(text, testing::AnyOf(HasSubstr("degenerate"), HasSubstr("folded")));
    }
  }
  EXPECT_GT(refused, 30);
  EXPECT_GT(accepted, 30);
}

TEST_P(EveryShape, TheOrderOfCellsAndVerticesDoesNotMatter) {
  std::mt19937 random(2);
  for (int trial = 0; trial < 20; ++trial) {
    const MeshFile good = block(GetParam(), 2);
    std::vector<std::uint32_t> to(good.points.size()), order(good.n_cells());
    for (std::uint32_t i = 0; i < to.size(); ++i)
      to[i] = i;
    for (std::uint32_t i = 0; i < order.size(); ++i)
      order[i] = i;
    std::shuffle(to.begin(), to.end(), random);
    std::shuffle(order.begin(), order.end(), random);
    MeshFile mesh = good;
    const std::size_t each = mesh.vertices_per_cell();
    for (std::size_t i = 0; i < to.size(); ++i)
      mesh.points[to[i]] = good.points[i];
    for (std::size_t cell = 0; cell < order.size(); ++cell)
      for (std::size_t i = 0; i < each; ++i)
        mesh.cells[cell * each + i] = to[good.cells[order[cell] * each + i]];
    const MeshFile whole = completed(mesh);
    EXPECT_EQ(whole.n_facets(), completed(good).n_facets());
    EXPECT_EQ(whole.n_cells(), good.n_cells());
  }
}

TEST_P(EveryShape, WhatIsNoMeshIsRefusedWithItsPlace) {
  const MeshFile good = block(GetParam(), 2);
  MeshFile mesh = good;
  mesh.points[4][1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(complaint(mesh), HasSubstr("has a vertex at (1, nan, 0)"));
  mesh = good;
  mesh.points[4][0] = std::numeric_limits<double>::infinity();
  EXPECT_THAT(complaint(mesh), HasSubstr("finite numbers"));
  mesh = good;
  mesh.cells[1] = mesh.cells[0];
  EXPECT_THAT(complaint(mesh), HasSubstr("has a cell at (0, 0, 0) that is degenerate"));
  mesh = good;
  mesh.cells.insert(mesh.cells.end(), good.cells.begin(),
                    good.cells.begin() + static_cast<std::ptrdiff_t>(good.vertices_per_cell()));
  mesh.regions.set_of.push_back(0);
  EXPECT_THAT(complaint(mesh), HasSubstr("lists the cell at (0, 0, 0) twice"));
}

TEST(Completed, AFacetOfThreeCellsIsRefused) {
  const std::vector<Point> points{{0, 0, 0}, {1, 0, 0}, {0.5, 1, 0}, {0.5, -1, 0}, {0.5, 2, 0}};
  EXPECT_THAT(complaint(of(CellShape::triangle, points, {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}})),
              HasSubstr("has a facet of 3 cells at (0, 0, 0)"));
}

// Every pair of neighbours fits, but together they go around the middle twice.
TEST(Completed, CellsThatGoAroundAVertexOrAnEdgeTwiceAreRefused) {
  constexpr std::uint32_t n = 10;
  const auto rim = [](std::uint32_t i, double z) {
    const double angle = 4 * std::numbers::pi * i / n, radius = 1 + 0.1 * i;
    return Point{radius * std::cos(angle), radius * std::sin(angle), z};
  };
  std::vector<Point> points{{0, 0, 0}};
  Cells cells;
  for (std::uint32_t i = 0; i < n; ++i) {
    points.push_back(rim(i, 0));
    cells.push_back({0, 1 + i, 1 + (i + 1) % n});
  }
  EXPECT_THAT(complaint(of(CellShape::triangle, points, cells)),
              HasSubstr("the cells around (0, 0, 0) overlap"));
  points.push_back({0, 0, 1});
  for (auto &cell : cells)
    cell.push_back(n + 1);
  EXPECT_THAT(complaint(of(CellShape::tetrahedron, points, cells)),
              HasSubstr("the cells around (0, 0, 0.5) overlap"));
}

TEST(Completed, QuadrilateralsThatAreNotConvexOrCrossThemselvesAreRefused) {
  const std::vector<Point> points{{0, 0, 0}, {1, 0, 0}, {0.2, 0.2, 0}, {0, 1, 0}};
  EXPECT_THAT(complaint(of(CellShape::quadrilateral, points, {{0, 1, 2, 3}})),
              HasSubstr("not convex"));
  const std::vector<Point> square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  EXPECT_THAT(complaint(of(CellShape::quadrilateral, square, {{0, 2, 1, 3}})),
              HasSubstr("degenerate"));
}

// At its corners the Jacobian is 0.078 at least, inside it falls to -0.48.
TEST(Completed, AHexahedronThatIsFoldedBetweenItsCornersIsRefused) {
  const std::vector<Point> points{{0.25, 0.5, 0},      {1.75, 0.5, 0.75},   {0.5, 1.75, 0.5},
                                  {-0.25, 1.25, -0.5}, {0.75, -0.25, 1.25}, {0.5, 0.25, 1.75},
                                  {1.5, 0.75, 0.75},   {-0.5, 1.5, 1.75}};
  EXPECT_THAT(complaint(of(CellShape::hexahedron, points, {{0, 1, 2, 3, 4, 5, 6, 7}})),
              HasSubstr("degenerate"));
}

// The two sides of the square are two sheets: both cells of the shared edge lie above it.
TEST(Completed, NeighboursOnTheSameSideOfTheirFacetAreRefused) {
  EXPECT_THAT(complaint(of(CellShape::quadrilateral,
                           {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {1.5, 2, 0}, {-0.5, 2, 0}},
                           {{0, 1, 2, 3}, {0, 1, 4, 5}})),
              HasSubstr("is folded at (0.5, 0, 0)"));
}

}  // namespace
}  // namespace tourmaline::mesh
