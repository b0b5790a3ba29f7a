// The contact of a plane body along its facets, each connected piece apart.
#include "report/contact_line.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace tourmaline::report {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using Places = std::vector<std::pair<double, double>>;

// Nodes are numbered by x, then y; on a circle neighbours are far apart in that order.
struct Ring {
  Places places;
  NamedFacets facets;

  /// A polygon of n nodes; of the facets the first `taken`, in an order of no pattern.
  Ring(int n, int taken) : facets{"rim", {}} {
    std::vector<std::pair<std::pair<double, double>, int>> sorted;
    for (int i = 0; i < n; ++i) {
      const double angle = 2 * std::numbers::pi * (i + 0.3) / n;
      sorted.push_back({{std::cos(angle), std::sin(angle)}, i});
    }
    std::sort(sorted.begin(), sorted.end());
    std::vector<std::uint32_t> number(n);
    for (int k = 0; k < n; ++k)
      number[sorted[k].second] = 10 + 3 * static_cast<std::uint32_t>(k);
    std::vector<bool> used(n, false);
    for (int k = 0; k < taken; ++k) {
      const int i = (7 * k) % taken;
      used[i] = used[(i + 1) % n] = true;
      if (k % 2)
        facets.facets.push_back({number[i], number[(i + 1) % n]});
      else
        facets.facets.push_back({number[(i + 1) % n], number[i]});
    }
    for (const auto &[place, i] : sorted)
      if (used[i])
        places.push_back(place);
  }
};

double chord(int n) {
  return 2 * std::sin(std::numbers::pi / n);
}

void expect_no_jumps(const ContactPiece &piece, const Places &places, double step) {
  for (std::size_t i = 1; i < piece.rows.size(); ++i) {
    const auto &a = places[piece.rows[i - 1]], &b = places[piece.rows[i]];
    EXPECT_NEAR(std::hypot(b.first - a.first, b.second - a.second), step, 1e-12);
    EXPECT_NEAR(piece.along[i] - piece.along[i - 1], step, 1e-12);
  }
}

TEST(ContactPieces, AnArcWhoseLeftmostNodeIsAmidItIsOneLineFromEndToEnd) {
  const Ring ring(20, 16);
  const auto pieces = contact_pieces({ring.facets}, ring.places);
  ASSERT_EQ(pieces.size(), 1U);
  EXPECT_EQ(pieces[0].rows.size(), 17U);
  expect_no_jumps(pieces[0], ring.places, chord(20));
  EXPECT_NEAR(pieces[0].along.back(), 16 * chord(20), 1e-12);
}

TEST(ContactPieces, AClosedCurveReturnsToItsStatedOriginCounterClockwise) {
  const Ring ring(25, 25);
  const auto pieces = contact_pieces({ring.facets}, ring.places);
  ASSERT_EQ(pieces.size(), 1U);
  const ContactPiece &piece = pieces[0];
  EXPECT_EQ(piece.rows.size(), 26U);
  EXPECT_EQ(piece.rows.front(), 0U);
  EXPECT_EQ(piece.rows.back(), 0U);
  expect_no_jumps(piece, ring.places, chord(25));
  const auto &a = ring.places[piece.rows[0]], &b = ring.places[piece.rows[1]];
  EXPECT_GT(a.first * b.second - a.second * b.first, 0);
  EXPECT_THAT(piece.origin, HasSubstr("counter-clockwise"));
}

TEST(ContactPieces, TwoSidesOfAPlateAreTwoPieces) {
  const Places places{{0, 0}, {0, 1}, {1, 0}, {1, 1}, {2, 0}, {2, 1}};
  const NamedFacets bottom{"bottom", {{2, 4}, {0, 2}}}, top{"top", {{1, 3}, {5, 3}}};
  const auto pieces = contact_pieces({bottom, top}, places);
  ASSERT_EQ(pieces.size(), 2U);
  EXPECT_EQ(pieces[0].name, "bottom");
  EXPECT_THAT(pieces[0].rows, ElementsAre(0, 2, 4));
  EXPECT_THAT(pieces[0].along, ElementsAre(0, 1, 2));
  EXPECT_EQ(pieces[0].abscissa, "x [m]");
  EXPECT_EQ(pieces[1].name, "top");
  EXPECT_THAT(pieces[1].rows, ElementsAre(1, 3, 5));
}

TEST(ContactPieces, MiddleNodesOfQuadraticFacetsStandBetweenTheirEnds) {
  const Places places{{0, 0}, {0, 0.5}, {0, 1}, {0, 1.5}, {0, 2}};
  const auto pieces = contact_pieces({{"left", {{4, 3, 2}, {0, 1, 2}}}}, places);
  ASSERT_EQ(pieces.size(), 1U);
  EXPECT_THAT(pieces[0].rows, ElementsAre(0, 1, 2, 3, 4));
  EXPECT_EQ(pieces[0].abscissa, "y [m]");
}

TEST(ContactPieces, EndWhereMoreThanTwoFacetsMeet) {
  const Places places{{0, 0}, {0, 2}, {1, 1}, {2, 0}, {2, 2}};
  const auto pieces = contact_pieces({{"cross", {{0, 2}, {2, 4}, {1, 2}, {2, 3}}}}, places);
  ASSERT_EQ(pieces.size(), 4U);
  for (const ContactPiece &piece : pieces)
    EXPECT_EQ(piece.rows.size(), 2U);
}

TEST(ContactPieces, AreNoneWhereTheTableHasOtherNodes) {
  EXPECT_TRUE(contact_pieces({{"left", {{0, 1}}}}, {{0, 0}}).empty());
}

// Around the corner at node 2, which is the second contact's.
TEST(ContactPieces, OfSeveralContactsEndWithTheirOwnNodes) {
  const Places places{{0, 3}, {0, 2}, {0, 0}, {0, 1}, {1, 0}, {2, 0}, {3, 0}};
  const NamedFacets left{"left", {{0, 1}, {1, 3}, {3, 2}}, 1},
      bottom{"bottom", {{2, 4}, {4, 5}, {5, 6}}, 0};
  const auto pieces = contact_pieces({left, bottom}, places, {1, 1, 1, 1, 0, 0, 0});
  ASSERT_EQ(pieces.size(), 2u);
  EXPECT_EQ(pieces[0].name, "left");
  EXPECT_EQ(pieces[0].along, (std::vector<double>{0, 1, 2, 3}));
  EXPECT_EQ(pieces[1].name, "bottom");
  EXPECT_EQ(pieces[1].along, (std::vector<double>{1, 2, 3}));
  EXPECT_EQ(contact_pieces({left, {"bottom", bottom.facets, 1}}, places).size(), 1u);
}

}  // namespace
}  // namespace tourmaline::report
