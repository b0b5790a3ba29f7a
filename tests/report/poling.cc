#include "report/poling.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "../output/small_body.h"
#include "body/discretisation.h"
#include "mesh/mesh.h"
#include "report/setting.h"
#include "tourmaline/case/case.h"

namespace tourmaline::report {
namespace {

Vector3 middle(const PolingArrow &arrow) {
  Vector3 m;
  for (int i = 0; i < 3; ++i)
    m[i] = (arrow.tail[i] + arrow.tip[i]) / 2;
  return m;
}

double distance(const Vector3 &a, const Vector3 &b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

/// What stands in the cell with that centre.
struct Cell {
  float region = 0;
  std::array<float, 3> poling{};
};

Result result_of(const output::Grid &grid, Cell (*at)(const Vector3 &centre)) {
  Result result;
  result.dimension = grid.dimension;
  result.skin = skin_of(grid);
  for (const std::uint32_t node : result.skin.nodes)
    result.points.push_back(grid.points[node]);
  Field region{"region", "", false, {""}, {{}}}, poling{"poling", "", false, {"x", "y", "z"}, {}};
  poling.values.resize(3);
  for (const std::uint32_t cell : result.skin.cells) {
    Vector3 centre{};
    for (std::size_t a = 0; a < grid.nodes_per_cell; ++a)
      for (int i = 0; i < 3; ++i)
        centre[i] += grid.points[grid.connectivity[cell * grid.nodes_per_cell + a]][i] /
                     static_cast<double>(grid.nodes_per_cell);
    const Cell here = at(centre);
    region.values[0].push_back(here.region);
    for (int i = 0; i < 3; ++i)
      poling.values[i].push_back(here.poling[i]);
  }
  result.fields = {region, poling};
  return result;
}

TEST(PolingArrows, StandEvenlyAllOverTheBody) {
  const auto arrows = poling_arrows(result_of(output::square(32), [](const Vector3 &) {
    return Cell{0, {0.6F, 0.8F, 0}};
  }));
  EXPECT_EQ(arrows.size(), 36U);
  for (const PolingArrow &arrow : arrows) {
    const double length = distance(arrow.tail, arrow.tip);
    EXPECT_NEAR((arrow.tip[0] - arrow.tail[0]) / length, 0.6, 1e-6);
    EXPECT_NEAR((arrow.tip[1] - arrow.tail[1]) / length, 0.8, 1e-6);
    double nearest = 1;
    for (const PolingArrow &other : arrows)
      if (&other != &arrow)
        nearest = std::min(nearest, distance(middle(arrow), middle(other)));
    EXPECT_NEAR(nearest, 1 / 6., 0.01);
    EXPECT_LT(length, nearest);
    for (const Vector3 &end : {arrow.tail, arrow.tip})
      for (const int axis : {0, 1})
        EXPECT_TRUE(end[axis] > 0 && end[axis] < 1) << end[axis];
  }
}

TEST(PolingArrows, AreTheSameEachTime) {
  const Result result = result_of(output::square(7), [](const Vector3 &) {
    return Cell{0, {0, 1, 0}};
  });
  const auto first = poling_arrows(result), second = poling_arrows(result);
  ASSERT_EQ(first.size(), second.size());
  for (std::size_t i = 0; i < first.size(); ++i)
    EXPECT_TRUE(first[i].tail == second[i].tail && first[i].tip == second[i].tip);
}

TEST(PolingArrows, TellPartsApartAndLeaveOutWhatIsNotPoled) {
  // Poled up above, steel in between, poled down in a small part below.
  const auto arrows = poling_arrows(result_of(output::square(40), [](const Vector3 &centre) {
    if (centre[1] > 0.3)
      return Cell{0, {0, 1, 0}};
    return centre[1] > 0.2 ? Cell{1, {}} : Cell{2, {0, -1, 0}};
  }));
  std::size_t up = 0, down = 0;
  for (const PolingArrow &arrow : arrows) {
    const bool is_up = arrow.tip[1] > arrow.tail[1];
    ++(is_up ? up : down);
    for (const Vector3 &end : {arrow.tail, arrow.tip})
      EXPECT_TRUE(is_up ? end[1] > 0.3 : end[1] < 0.2) << end[1];
  }
  EXPECT_GE(up, 20U);
  EXPECT_GE(down, 6U);
}

TEST(PolingArrows, ShowBothDirectionsWhereAFormulaTurnsThePolingOver) {
  // One region: the lower fifth is poled down, all else up.
  const auto arrows = poling_arrows(result_of(output::square(40), [](const Vector3 &centre) {
    return Cell{0, {0, centre[1] > 0.2 ? 1.F : -1.F, 0}};
  }));
  std::size_t up = 0, down = 0;
  for (const PolingArrow &arrow : arrows) {
    const bool is_up = arrow.tip[1] > arrow.tail[1];
    ++(is_up ? up : down);
    for (const Vector3 &end : {arrow.tail, arrow.tip})
      EXPECT_TRUE(is_up ? end[1] > 0.2 : end[1] < 0.2) << end[1];
  }
  EXPECT_GE(up, 20U);
  EXPECT_GE(down, 6U);
}

TEST(PolingArrows, FollowAPolingThatTurnsSmoothlyAsOnePart) {
  // Around the middle of the square, through all directions; the middle itself is not poled.
  const auto arrows = poling_arrows(result_of(output::square(40), [](const Vector3 &centre) {
    const double x = centre[0] - 0.5, y = centre[1] - 0.5, r = std::hypot(x, y);
    return r < 0.1 ? Cell{} : Cell{0, {static_cast<float>(-y / r), static_cast<float>(x / r), 0}};
  }));
  EXPECT_THAT(arrows.size(), testing::AllOf(testing::Ge(30U), testing::Le(58U)));
}

TEST(PolingArrows, StayFewWhereThePolingChangesFromCellToCell) {
  const auto arrows = poling_arrows(result_of(output::square(40), [](const Vector3 &centre) {
    const int checks = static_cast<int>(centre[0] * 40) + static_cast<int>(centre[1] * 40);
    return Cell{0, {checks % 2 == 0 ? 1.F : -1.F, 0, 0}};
  }));
  EXPECT_THAT(arrows.size(), testing::AllOf(testing::Ge(10U), testing::Le(120U)));
}

TEST(PolingArrows, BeginInTheirPartWhereItIsTooThinForThem) {
  output::Grid strip = output::square(40);
  for (Vector3 &point : strip.points)
    point[1] /= 40;
  const auto arrows = poling_arrows(result_of(strip, [](const Vector3 &centre) {
    return centre[1] > 0.0125 ? Cell{0, {0, 1, 0}} : Cell{1, {0, -1, 0}};
  }));
  ASSERT_GE(arrows.size(), 12U);
  for (const PolingArrow &arrow : arrows) {
    const bool is_up = arrow.tip[1] > arrow.tail[1];
    EXPECT_TRUE(is_up ? arrow.tail[1] > 0.0125 && arrow.tail[1] < 0.025
                      : arrow.tail[1] > 0 && arrow.tail[1] < 0.0125);
    EXPECT_GT(distance(arrow.tail, arrow.tip), 0.04);
  }
}

TEST(PolingArrows, OfASolidStandOnTheFacesThatAreSeen) {
  casefile::MeshCase mesh;
  mesh.box = casefile::Box{{0, 0, 0}, {1, 1, 1}, {5, 5, 5}, casefile::CellShape::tetrahedron};
  const body::Discretisation<3> body(mesh::build<3>(mesh), 1);
  const auto arrows = poling_arrows(result_of(body.grid(), [](const Vector3 &) {
    return Cell{0, {0, 0, 1}};
  }));
  std::array<int, 3> faces{};  // left, front, top, as the view looks from there
  for (const PolingArrow &arrow : arrows) {
    const Vector3 at = middle(arrow);
    const std::array<double, 3> away{at[0], at[1], 1 - at[2]};
    const auto face = std::min_element(away.begin(), away.end());
    EXPECT_NEAR(*face, 0, 1e-6);
    ++faces[face - away.begin()];
  }
  for (const int number : faces)
    EXPECT_GE(number, 4);
}

TEST(PolingArrows, ThereAreNoneWhereTheFilesDoNotTellThePoling) {
  Result result = result_of(output::square(4), [](const Vector3 &) { return Cell{}; });
  EXPECT_TRUE(poling_arrows(result).empty());
  result.fields.clear();
  EXPECT_TRUE(poling_arrows(result).empty());
}

TEST(Parts, AreListedWithTheirMaterialsWhereThereAreSeveral) {
  Result result;
  result.asked.emplace();
  result.asked->regions.resize(1);
  result.asked->regions[0].on = {"a", "b"};
  result.asked->regions[0].material.library = "steel";
  EXPECT_TRUE(parts_of(result).empty());
  result.asked->regions.resize(2);
  result.asked->regions[1].inside = casefile::Formula("y > 0.1");
  const std::vector<Part> parts = parts_of(result);
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_EQ(parts[0].name, "a, b");
  EXPECT_EQ(parts[0].material, "steel");
  EXPECT_EQ(parts[1].name, "y > 0.1");
  EXPECT_EQ(parts[1].material, "material of the case");
}

}  // namespace
}  // namespace tourmaline::report
