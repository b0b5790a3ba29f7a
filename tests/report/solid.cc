#include "report/solid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "body/discretisation.h"
#include "mesh/mesh.h"
#include "tourmaline/case/case.h"

namespace tourmaline::report {
namespace {

using casefile::CellShape;

output::Grid box(CellShape cell, int degree) {
  casefile::MeshCase mesh;
  mesh.box = casefile::Box{{0, 0, 0}, {2, 3, 4}, {3, 2, 4}, cell};
  return body::Discretisation<3>(mesh::build<3>(mesh), degree).grid();
}

Vector3 place(const output::Grid &grid, const Skin &skin, const Solid &solid, std::uint32_t node) {
  const std::size_t outer = skin.nodes.size();
  return node < outer ? grid.points[skin.nodes[node]] : solid.points.at(node - outer);
}

double six_volumes(const std::array<Vector3, 4> &p) {
  double e[3][3];
  for (int i = 0; i < 3; ++i)
    for (int c = 0; c < 3; ++c)
      e[i][c] = p[i + 1][c] - p[0][c];
  return e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) -
         e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
         e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
}

/// Of a tetrahedron, or of a hexahedron by the six that share its diagonal.
double volume(const std::vector<Vector3> &p) {
  if (p.size() == 4)
    return six_volumes({p[0], p[1], p[2], p[3]}) / 6;
  double sum = 0;
  constexpr int around[7] = {1, 2, 3, 7, 4, 5, 1};
  for (int i = 0; i < 6; ++i)
    sum += six_volumes({p[0], p[around[i]], p[around[i + 1]], p[6]}) / 6;
  return sum;
}

TEST(Solid, ItsPartsFillTheBodyAndEachStandsTheRightWayRound) {
  for (const CellShape cell : {CellShape::tetrahedron, CellShape::hexahedron})
    for (const int degree : {1, 2}) {
      const output::Grid grid = box(cell, degree);
      const Skin skin = skin_of(grid);
      const Solid solid = solid_of(grid, skin);
      double sum = 0, least = 1;
      for (std::size_t p = 0; p < solid.part_cells.size(); ++p) {
        std::vector<Vector3> corners;
        for (std::size_t k = 0; k < solid.corners; ++k)
          corners.push_back(place(grid, skin, solid, solid.parts[p * solid.corners + k]));
        least = std::min(least, volume(corners));
        sum += volume(corners);
      }
      EXPECT_NEAR(sum, 24, 1e-12) << degree;
      EXPECT_GT(least, 0) << degree;
    }
}

TEST(Solid, EveryNodeAndCellIsTheSkinsOrBehindIt) {
  for (const CellShape cell : {CellShape::tetrahedron, CellShape::hexahedron})
    for (const int degree : {1, 2}) {
      const output::Grid grid = box(cell, degree);
      const Skin skin = skin_of(grid);
      const Solid solid = solid_of(grid, skin);
      EXPECT_EQ(skin.nodes.size() + solid.nodes.size(), grid.points.size());
      EXPECT_EQ(skin.cells.size() + solid.cells.size(), grid.n_cells());
      const std::set<std::uint32_t> used(solid.parts.begin(), solid.parts.end());
      EXPECT_EQ(used.size(), grid.points.size());
      EXPECT_EQ(*used.rbegin(), grid.points.size() - 1);
      const std::set<std::uint32_t> cells(solid.part_cells.begin(), solid.part_cells.end());
      EXPECT_EQ(cells.size(), grid.n_cells());
    }
}

}  // namespace
}  // namespace tourmaline::report
