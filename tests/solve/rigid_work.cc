#include "solve/rigid_work.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace tourmaline::solve {
namespace {

// Along x and y together, and about the point (1, 0).
RigidWork oblique_and_turning() {
  const double s = std::sqrt(0.5);
  return RigidWork({{{s, s, 0}, {}, {}}, {{}, {0, 0, 1}, {1, 0, 0}}});
}

void add(RigidWork &work, const Vector3 &point, const Vector3 &force) {
  work.add(point, force.data(), 3);
}

TEST(RigidWork, ForcesThatBalanceDoNone) {
  RigidWork work = oblique_and_turning();
  EXPECT_EQ(work.imbalance(RigidWork::summed), 0);
  add(work, {0, 0, 0}, {3, 1, 0});
  add(work, {0, 0, 0}, {-1, -3, 0});  // together across the motion
  add(work, {2, 0, 0}, {0, -2, 0});
  add(work, {2, 0, 0}, {2, 0, 0});
  EXPECT_LT(work.imbalance(RigidWork::summed), 1e-15);
  add(work, {2, 0, 0}, {1, -1, 0});  // turns it: -1 beside -1, 3 and -2
  EXPECT_NEAR(work.imbalance(0), 1. / 7, 1e-15);
}

TEST(RigidWork, IsMeasuredByWhatWorks) {
  RigidWork work = oblique_and_turning();
  add(work, {1, 0, 0}, {1e6, -1e6, 0});  // does none
  add(work, {1, 0, 0}, {1, 1, 0});
  add(work, {1, 0, 0}, {-0.99, -0.99, 0});
  EXPECT_NEAR(work.imbalance(0), 0.01 / 1.99, 1e-9);
  EXPECT_LT(work.imbalance(RigidWork::uncertain), RigidWork::unbalanced);
  EXPECT_EQ(work.imbalance(0, 0.02), 0);
  EXPECT_GT(work.imbalance(0, 0.01), RigidWork::unbalanced);
}

TEST(RigidWork, WhatIsNoNumberDoesNotBalance) {
  RigidWork work = oblique_and_turning();
  add(work, {0, 0, 0}, {1, -1, 0});
  EXPECT_TRUE(std::isnan(work.imbalance(0, std::numeric_limits<double>::infinity())));
  add(work, {0, 0, 0}, {std::nan(""), 0, 0});
  EXPECT_TRUE(std::isnan(work.imbalance(RigidWork::summed)));
}

}  // namespace
}  // namespace tourmaline::solve
