#include "case/snapping.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "example.h"
#include "tourmaline/case/reader.h"

namespace tourmaline::casefile {
namespace {

using testing::HasSubstr;
using testing::Not;

std::string first(const std::vector<std::string> &warnings) {
  return warnings.empty() ? "" : warnings.front();
}

// With mu from `at_rest` to `kinetic`.
std::string warning(const std::string &at_rest, const std::string &kinetic) {
  return first(
      snapping_warnings(read_text(example, "case.toml",
                                  {"contact.friction={law='coulomb', coefficient={static='" +
                                   at_rest + "', kinetic='" + kinetic + "', speed=1e-3}}"})));
}

TEST(Snapping, IsFearedWhereFrictionFallsAsTheContactSlips) {
  EXPECT_THAT(warning("0.4", "0.2"), HasSubstr("static = 0.4 is above kinetic = 0.2"));
  EXPECT_THAT(warning("0.2", "0.4"), HasSubstr("static = 0.2 is below kinetic = 0.4"));
  EXPECT_THAT(warning("0.2", "0.4"), HasSubstr("nothing snaps"));
  EXPECT_EQ(warning("0.3", "0.3"), "");
}

// The contact is the side x = 0 with y from 0 to 0.1; the steps end from t = 0.01 to t = 0.2.
TEST(Snapping, IsJudgedOnTheContactDuringTheRun) {
  const auto falls = HasSubstr("friction falls");
  EXPECT_THAT(warning("y", "0.05"), falls);
  EXPECT_THAT(warning("x", "0.05"), Not(falls));
  EXPECT_THAT(warning("y", "0.15"), Not(falls));
  EXPECT_THAT(warning("t", "0.15"), falls);
  EXPECT_THAT(warning("t", "0.25"), Not(falls));
  EXPECT_THAT(warning("0.1/t", "20"), Not(falls));
}

TEST(Snapping, IsNotFearedOfAConstantCoefficient) {
  EXPECT_TRUE(snapping_warnings(read_text(example, "case.toml",
                                          {"contact.friction={law='coulomb', coefficient=0.3}"}))
                  .empty());
  EXPECT_TRUE(snapping_warnings(read_text(example, "case.toml")).empty());
  EXPECT_TRUE(snapping_warnings(read_text(cube, "cube.toml")).empty());
}

TEST(Snapping, IsFearedOfEachContact) {
  const std::string law =
      ", friction={law='coulomb', coefficient={static=0.4, kinetic=0.2, speed=1e-3}}}";
  EXPECT_EQ(
      snapping_warnings(read_text(example, "case.toml",
                                  {"contact=[{on='left'" + law + ", {on='bottom'" + law + "]"}))
          .size(),
      2u);
}

}  // namespace
}  // namespace tourmaline::casefile
