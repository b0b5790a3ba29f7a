#include "case/snapping.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "example.h"
#include "tourmaline/case/reader.h"

namespace tourmaline::casefile {
namespace {

using testing::HasSubstr;

// With mu from `at_rest` to `kinetic`.
std::string warning(const std::string &at_rest, const std::string &kinetic) {
  return snapping_warning(read_text(example, "case.toml",
                                    {"contact.friction={law='coulomb', coefficient={static='" +
                                     at_rest + "', kinetic='" + kinetic + "', speed=1e-3}}"}));
}

TEST(Snapping, IsFearedWhereFrictionFallsAsTheContactSlips) {
  EXPECT_THAT(warning("0.4", "0.2"), HasSubstr("static = 0.4 is above kinetic = 0.2"));
  EXPECT_EQ(warning("0.2", "0.4"), "");
  EXPECT_EQ(warning("0.3", "0.3"), "");
}

// The contact is the side x = 0 with y from 0 to 0.1; the steps end from t = 0.01 to t = 0.2.
TEST(Snapping, IsJudgedOnTheContactDuringTheRun) {
  EXPECT_NE(warning("y", "0.05"), "");
  EXPECT_EQ(warning("x", "0.05"), "");
  EXPECT_EQ(warning("y", "0.15"), "");
  EXPECT_NE(warning("t", "0.15"), "");
  EXPECT_EQ(warning("t", "0.25"), "");
  EXPECT_EQ(warning("0.1/t", "20"), "");
}

TEST(Snapping, IsNotFearedOfAConstantCoefficient) {
  EXPECT_EQ(snapping_warning(read_text(example, "case.toml",
                                       {"contact.friction={law='coulomb', coefficient=0.3}"})),
            "");
  EXPECT_EQ(snapping_warning(read_text(example, "case.toml")), "");
  EXPECT_EQ(snapping_warning(read_text(cube, "cube.toml")), "");
}

}  // namespace
}  // namespace tourmaline::casefile
