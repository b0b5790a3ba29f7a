#include "case/nearest.h"

#include <gtest/gtest.h>

namespace tourmaline::casefile {
namespace {

TEST(EditDistance, CountsInsertionsDeletionsReplacementsAndSwaps) {
  EXPECT_EQ(edit_distance("friction", "friction"), 0);
  EXPECT_EQ(edit_distance("frictoin", "friction"), 1);
  EXPECT_EQ(edit_distance("fricton", "friction"), 1);
  EXPECT_EQ(edit_distance("frictionn", "friction"), 1);
  EXPECT_EQ(edit_distance("fraction", "friction"), 1);
  EXPECT_EQ(edit_distance("", "top"), 3);
}

TEST(EditDistance, DoesNotMindCapitals) {
  EXPECT_EQ(edit_distance("Top", "top"), 0);
}

TEST(EditDistance, IsSymmetric) {
  EXPECT_EQ(edit_distance("bound", "boundary"), edit_distance("boundary", "bound"));
}

TEST(Nearest, FindsTheNameThatWasMeant) {
  EXPECT_EQ(nearest("frictoin", {"normal", "friction", "heat"}), "friction");
  EXPECT_EQ(nearest("lfet", {"left", "right", "bottom", "top"}), "left");
  EXPECT_EQ(nearest("C13", {"c11", "c13", "c33"}), "c13");
}

TEST(Nearest, UnderstandsAbbreviations) {
  EXPECT_EQ(nearest("temp", {"potential", "temperature"}), "temperature");
  EXPECT_EQ(nearest("iterations", {"tolerance", "max_iterations"}), "max_iterations");
}

TEST(Nearest, DoesNotGuessWildly) {
  EXPECT_EQ(nearest("viscosity", {"on", "normal", "friction", "heat"}), std::nullopt);
  EXPECT_EQ(nearest("x", {"on"}), std::nullopt);
  EXPECT_EQ(nearest("", {"on"}), std::nullopt);
  EXPECT_EQ(nearest("on", {}), std::nullopt);
  EXPECT_EQ(nearest(std::string(100000, 'a'), {"on"}), std::nullopt);
}

TEST(DidYouMean, IsSilentWhenNothingIsNear) {
  EXPECT_EQ(did_you_mean("frictoin", {"friction"}), "; did you mean \"friction\"?");
  EXPECT_EQ(did_you_mean("viscosity", {"friction"}), "");
}

}  // namespace
}  // namespace tourmaline::casefile
