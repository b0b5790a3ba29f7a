#include "run/step_ladder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace tourmaline::run {
namespace {

// With errors that belong to pairs of `fitting` seconds.
std::vector<StepLadder::Pair> climb(StepLadder &ladder, double fitting) {
  std::vector<StepLadder::Pair> taken;
  for (int tries = 0; !ladder.is_at_end() && tries < 10000; ++tries) {
    const StepLadder::Pair pair = ladder.pair();
    const double error = std::pow(2 * pair.size / fitting, 2);
    if (error > 1) {
      ladder.reject(error);
      continue;
    }
    taken.push_back(pair);
    ladder.accept(error);
  }
  return taken;
}

TEST(StepLadder, WithoutErrorsTakesTheLongestSteps) {
  StepLadder ladder(1, 0.05, {});
  const auto taken = climb(ladder, 1e3);
  ASSERT_EQ(taken.size(), 10);
  for (const StepLadder::Pair &pair : taken)
    EXPECT_DOUBLE_EQ(pair.size, 0.05);
  EXPECT_EQ(taken.back().end, 1);
}

TEST(StepLadder, EndsAtEveryBendAndAtTheEnd) {
  StepLadder ladder(1, 0.05, {0.123, 0.4567, 0.5});
  std::set<double> ends;
  double before = 0;
  for (const StepLadder::Pair &pair : climb(ladder, 0.03)) {
    EXPECT_NEAR(pair.middle - before, pair.size, 1e-12);
    EXPECT_NEAR(pair.end - pair.middle, pair.size, 1e-12);
    EXPECT_LE(2 * pair.size, 0.03);
    ends.insert(before = pair.end);
  }
  for (const double time : {0.123, 0.4567, 0.5, 1.})
    EXPECT_EQ(ends.count(time), 1) << time;
}

TEST(StepLadder, HasFewSizesWhereTheStretchesHaveAUnit) {
  StepLadder ladder(1, 0.1, {0.25, 0.5, 0.75});
  std::set<double> sizes;
  for (const StepLadder::Pair &pair : climb(ladder, 0.02))
    sizes.insert(pair.size);
  EXPECT_LE(sizes.size(), 5);
  for (const double size : sizes)
    EXPECT_EQ(std::log2(size / *sizes.begin()), std::round(std::log2(size / *sizes.begin())));
}

TEST(StepLadder, GrowsAgainWhereErrorsFall) {
  StepLadder ladder(1, 0.5, {});
  while (ladder.pair().size > 1e-3)
    ladder.reject(4);
  const double small = ladder.pair().size;
  for (const double times : {1., 1., 2., 4., 8., 16.}) {
    EXPECT_EQ(ladder.pair().size, times * small);
    ladder.accept(1e-9);
  }
  const double large = ladder.pair().size;
  ladder.accept(0.9);
  EXPECT_EQ(ladder.pair().size, large);
}

TEST(StepLadder, ThatABendCutsShortGoesOnAsBefore) {
  StepLadder ladder(1, 0.1, {0.21});
  const double size = ladder.pair().size;
  ladder.accept(0.9);
  EXPECT_LT(ladder.pair().size, size);
  while (ladder.pair().end <= 0.21)
    ladder.accept(0.7 * std::pow(ladder.pair().size / size, 2));
  EXPECT_EQ(ladder.pair().size, size);
}

TEST(StepLadder, CannotShrinkForEver) {
  StepLadder ladder(1, 0.1, {});
  int rejected = 0;
  for (; ladder.can_shrink(); ++rejected) {
    ASSERT_LT(rejected, 40);
    ladder.reject(1.1);
  }
  EXPECT_LT(ladder.pair().size, 1e-7);
}

TEST(StepLadder, GoesOnFromWhatWasSaved) {
  StepLadder ladder(1, 0.05, {0.3}), other(1, 0.05, {0.3});
  ladder.reject(7);
  ladder.accept(0.5);
  ladder.accept(0.01);
  output::SavedNumbers saved;
  ladder.save(saved);
  other.restore(saved);
  while (!ladder.is_at_end()) {
    EXPECT_EQ(ladder.pair().size, other.pair().size);
    EXPECT_EQ(ladder.pair().middle, other.pair().middle);
    EXPECT_EQ(ladder.pair().end, other.pair().end);
    ladder.accept(0.7);
    other.accept(0.7);
  }
  EXPECT_TRUE(other.is_at_end());
}

}  // namespace
}  // namespace tourmaline::run
