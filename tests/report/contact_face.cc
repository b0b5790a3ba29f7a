// The contact of a solid body, laid out in a plane.
#include "report/contact_face.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

namespace tourmaline::report {
namespace {

using ::testing::HasSubstr;

/// A grid of rows x columns nodes with facets between them; closed across where `closed`.
struct Sheet {
  std::vector<Vector3> places;
  std::vector<ContactFacet> facets;

  template <class Place>
  Sheet(int columns, int rows, bool closed, Place place) {
    for (int j = 0; j < rows; ++j)
      for (int i = 0; i < columns; ++i)
        places.push_back(place(i, j));
    const auto at = [&](int i, int j) {
      return static_cast<std::uint32_t>(j * columns + i % columns);
    };
    for (int j = 0; j + 1 < rows; ++j)
      for (int i = 0; i + (closed ? 0 : 1) < columns; ++i)
        facets.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
  }
};

Sheet tube(int columns, int rows, double radius) {
  return {columns, rows, true, [=](int i, int j) {
            const double angle = 2 * std::numbers::pi * i / columns;
            return Vector3{radius * std::cos(angle), radius * std::sin(angle), 0.01 * j};
          }};
}

/// Places in the plane, to a thousandth of the unit, with the rows that lie there.
std::map<std::pair<long, long>, std::set<std::uint32_t>> rows_at(const ContactFace &face,
                                                                 double unit) {
  std::map<std::pair<long, long>, std::set<std::uint32_t>> rows;
  for (std::size_t i = 0; i < face.rows.size(); ++i)
    rows[{std::lround(1e3 * face.x[i] / unit), std::lround(1e3 * face.y[i] / unit)}].insert(
        face.rows[i]);
  return rows;
}

TEST(ContactFace, AFlatFaceIsSeenAlongItsNormal) {
  const Sheet sheet(4, 3, false, [](int i, int j) { return Vector3{0.1 * i, 0.05, 0.2 * j}; });
  const auto faces = contact_faces(sheet.facets, sheet.places);
  ASSERT_EQ(faces.size(), 1u);
  EXPECT_EQ(faces[0].place, "y = 0.05 m");
  EXPECT_EQ(faces[0].across, "x [m]");
  EXPECT_EQ(faces[0].up, "z [m]");
  EXPECT_EQ(faces[0].origin, "");
  for (std::size_t i = 0; i < faces[0].rows.size(); ++i) {
    EXPECT_EQ(faces[0].x[i], sheet.places[faces[0].rows[i]][0]);
    EXPECT_EQ(faces[0].y[i], sheet.places[faces[0].rows[i]][2]);
  }
}

TEST(ContactFace, ATubeIsUnrolledAndNoNodeHidesAnother) {
  const Sheet sheet = tube(40, 8, 0.02);
  const auto faces = contact_faces(sheet.facets, sheet.places);
  ASSERT_EQ(faces.size(), 1u);
  EXPECT_EQ(faces[0].place, "around z, radius 0.02 m");
  EXPECT_EQ(faces[0].across, "length around z [m]");
  EXPECT_THAT(faces[0].origin, HasSubstr("from x = 0.02 m, y = 0 m, counter-clockwise"));
  const auto rows = rows_at(faces[0], 0.02);
  // Those of the seam lie at both ends.
  EXPECT_EQ(rows.size(), 41u * 8);
  for (const auto &entry : rows)
    EXPECT_EQ(entry.second.size(), 1u);
  // A facet is as wide as the arc that it stands for, also at the seam.
  for (std::size_t first = 0; first < faces[0].rows.size(); first += 4)
    EXPECT_NEAR(std::abs(faces[0].x[first + 1] - faces[0].x[first]),
                2 * std::numbers::pi * 0.02 / 40, 1e-12);
}

TEST(ContactFace, HalfATubeBeginsWhereItsGapEnds) {
  const Sheet sheet(11, 3, false, [](int i, int j) {
    const double angle = std::numbers::pi * (0.75 + i / 10.);
    return Vector3{0.01 * j, 0.02 * std::cos(angle), 0.02 * std::sin(angle)};
  });
  const auto faces = contact_faces(sheet.facets, sheet.places);
  ASSERT_EQ(faces.size(), 1u);
  EXPECT_EQ(faces[0].up, "x [m]");
  const auto [low, high] = std::minmax_element(faces[0].x.begin(), faces[0].x.end());
  EXPECT_NEAR(*low, 0, 1e-12);
  EXPECT_NEAR(*high, std::numbers::pi * 0.02, 1e-12);
}

// Two sides of a box that meet at an edge.
TEST(ContactFace, OfAnEdgeEachSideIsSeenByItself) {
  const Sheet sheet(5, 3, false, [](int i, int j) {
    return i < 3 ? Vector3{0.1 * i, 0.1 * j, 0} : Vector3{0.2, 0.1 * j, 0.1 * (i - 2)};
  });
  const auto faces = contact_faces(sheet.facets, sheet.places);
  ASSERT_EQ(faces.size(), 2u);
  EXPECT_EQ(faces[0].place, "x = 0.2 m");
  EXPECT_EQ(faces[1].place, "z = 0 m");
  std::set<std::uint32_t> seen;
  for (const ContactFace &face : faces)
    seen.insert(face.rows.begin(), face.rows.end());
  EXPECT_EQ(seen.size(), sheet.places.size());
}

TEST(ContactFace, PartsThatAreApartAndContactsThatMeetAreApart) {
  Sheet sheet(5, 2, false, [](int i, int j) { return Vector3{0.1 * i, 0.1 * j, 0}; });
  const std::vector<std::size_t> contacts{0, 0, 0, 1, 1, 0, 0, 0, 1, 1};
  const auto two = contact_faces(sheet.facets, sheet.places, contacts, {"shoe", "brake"});
  ASSERT_EQ(two.size(), 2u);
  EXPECT_EQ(two[0].contact, "shoe");
  EXPECT_EQ(two[1].contact, "brake");
  sheet.facets.erase(sheet.facets.begin() + 1);
  const auto parts = contact_faces(sheet.facets, sheet.places);
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_EQ(parts[0].sizes.size(), 1u);
  EXPECT_EQ(parts[1].sizes.size(), 2u);
}

// The middle node of a quadratic facet is no corner, but has its place.
TEST(ContactFace, QuadraticFacetsKeepTheNodesAmidTheirSides) {
  std::vector<Vector3> places;
  for (const auto &[x, y] : {std::pair{0., 0.},
                             {2., 0.},
                             {2., 2.},
                             {0., 2.},
                             {1., 0.},
                             {2., 1.},
                             {1., 2.},
                             {0., 1.},
                             {1., 1.}})
    places.push_back({x, y, 1});
  const auto faces = contact_faces({{0, 1, 2, 3, 4, 5, 6, 7, 8}}, places);
  ASSERT_EQ(faces.size(), 1u);
  EXPECT_EQ(faces[0].sizes, std::vector<std::uint32_t>{9});
  EXPECT_EQ(faces[0].x[8], 1);
  EXPECT_EQ(corners_of(9), 4u);
  EXPECT_EQ(corners_of(6), 3u);
  EXPECT_EQ(corners_of(4), 4u);
}

}  // namespace
}  // namespace tourmaline::report
