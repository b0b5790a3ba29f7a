#include "report/skin.h"

#include <gtest/gtest.h>

#include <cmath>

#include "../output/small_body.h"
#include "body/discretisation.h"
#include "mesh/mesh.h"
#include "tourmaline/case/case.h"

namespace tourmaline::report {
namespace {

Vector3 cross_of(const Vector3 &u, const Vector3 &v) {
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}

/// Area, and the volume inside by Gauss's theorem: positive if the triangles face outward.
std::pair<double, double> area_and_volume(const output::Grid &grid) {
  const Skin skin = skin_of(grid);
  double area = 0, volume = 0;
  for (const auto &t : skin.triangles) {
    const Vector3 a = grid.points[skin.nodes[t[0]]], b = grid.points[skin.nodes[t[1]]],
                  c = grid.points[skin.nodes[t[2]]];
    Vector3 u, v;
    for (int i = 0; i < 3; ++i) {
      u[i] = b[i] - a[i];
      v[i] = c[i] - a[i];
    }
    const Vector3 n = cross_of(u, v);
    area += std::hypot(n[0], n[1], n[2]) / 2;
    volume += (a[0] * n[0] + a[1] * n[1] + a[2] * n[2]) / 6;
  }
  return {area, volume};
}

casefile::MeshCase box(casefile::CellShape cell) {
  casefile::MeshCase mesh;
  const bool plane = casefile::dimension_of(cell) == 2;
  mesh.box = casefile::Box{plane ? std::vector<double>{0, 0} : std::vector<double>{0, 0, 0},
                           plane ? std::vector<double>{2, 3} : std::vector<double>{2, 3, 4},
                           plane ? std::vector<int>{3, 2} : std::vector<int>{3, 2, 2}, cell};
  return mesh;
}

using casefile::CellShape;

TEST(Skin, OfAPlaneBodyItIsAllOfIt) {
  for (const CellShape cell : {CellShape::triangle, CellShape::quadrilateral})
    for (const int degree : {1, 2}) {
      const body::Discretisation<2> body(mesh::build<2>(box(cell)), degree);
      EXPECT_NEAR(area_and_volume(body.grid()).first, 6, 1e-13) << degree;
      EXPECT_EQ(skin_of(body.grid()).nodes.size(), body.n_nodes());
    }
}

TEST(Skin, OfASolidItIsTheSurfaceFacingOutward) {
  for (const CellShape cell : {CellShape::tetrahedron, CellShape::hexahedron})
    for (const int degree : {1, 2}) {
      const body::Discretisation<3> body(mesh::build<3>(box(cell)), degree);
      const auto [area, volume] = area_and_volume(body.grid());
      EXPECT_NEAR(area, 2 * (6 + 8 + 12), 1e-12) << degree;
      EXPECT_NEAR(volume, 24, 1e-12) << degree;
    }
}

TEST(Skin, EverySideOfACellIsDrawnOnce) {
  // n by n squares, each with a diagonal: n (n + 1) sides each way and n^2 diagonals.
  EXPECT_EQ(skin_of(output::square(3)).edges.size(), 12U + 12 + 9);
}

TEST(Skin, CountsTheFacetsOfTheWholeBoundary) {
  EXPECT_EQ(skin_of(output::square(5)).n_facets, 20U);
  casefile::MeshCase mesh;
  mesh.box = casefile::Box{{0, 0, 0}, {1, 1, 1}, {2, 3, 4}, casefile::CellShape::hexahedron};
  for (const int degree : {1, 2}) {
    const body::Discretisation<3> body(mesh::build<3>(mesh), degree);
    EXPECT_EQ(skin_of(body.grid()).n_facets, 2U * (2 * 3 + 3 * 4 + 4 * 2)) << degree;
  }
}

}  // namespace
}  // namespace tourmaline::report
