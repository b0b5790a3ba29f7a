#include "case/free_modes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tourmaline/case/case.h"

namespace tourmaline::casefile {
namespace {

using Place = std::array<double, 3>;

Case of(int dimension, const std::string &plane = "strain") {
  Case asked;
  asked.dimension = dimension;
  asked.model.plane = plane;
  return asked;
}

double along(const RigidMotion &motion, const Support &support) {
  const Place moved = motion.at(support.point);
  return moved[0] * support.direction[0] + moved[1] * support.direction[1] +
         moved[2] * support.direction[2];
}

TEST(FreeModes, AreAllOfABodyThatNothingHolds) {
  EXPECT_EQ(free_modes(of(2), {}, {}, 1).size(), 3U);
  EXPECT_EQ(free_modes(of(3), {}, {}, 1).size(), 6U);
}

TEST(FreeModes, AreNoneOfABodyThatIsHeld) {
  const Place x{1, 0, 0}, y{0, 1, 0};
  EXPECT_TRUE(free_modes(of(2), {{{0, 0}, x}, {{0, 0}, y}, {{1, 0}, y}}, {}, 1).empty());
}

TEST(FreeModes, OfABodyOfRevolutionTheOneIsAlongItsAxis) {
  const auto free = free_modes(of(2, "axisymmetric"), {{{1, 0}, {1, 0, 0}}}, {}, 1);
  ASSERT_EQ(free.size(), 1U);
  EXPECT_EQ(std::abs(free[0].at({2, 3, 0})[1]), 1);
  EXPECT_TRUE(free_modes(of(2, "axisymmetric"), {{{1, 0}, {0, 1, 0}}}, {}, 1).empty());
}

// Whatever the units, and far from the origin.
TEST(FreeModes, AreThoseThatNoSupportResists) {
  const double s = std::sqrt(0.5);
  for (const double size : {1e-6, 1., 1e3}) {
    const std::vector<Support> hinge{{{5 * size, size, 0}, {s, s, 0}},
                                     {{5 * size, size, 0}, {s, -s, 0}},
                                     {{5 * size, size, size}, {1, 0, 0}},
                                     {{5 * size, size, size}, {0, 1, 0}},
                                     {{5 * size, size, size}, {0, 0, 1}}};
    const auto free = free_modes(of(3), hinge, {5.3 * size, 0.4 * size, 0}, size);
    ASSERT_EQ(free.size(), 1U) << size;
    for (const Support &support : hinge)
      EXPECT_NEAR(along(free[0], support), 0, 1e-14);
    const Place far = free[0].at({6 * size, size, 0});
    EXPECT_NEAR(far[0], 0, 1e-14);
    EXPECT_GT(std::abs(far[1]), 0.3);
  }
}

}  // namespace
}  // namespace tourmaline::casefile
