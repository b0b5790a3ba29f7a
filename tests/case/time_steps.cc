#include "case/time_steps.h"

#include <gtest/gtest.h>

#include "tourmaline/case/case.h"

namespace tourmaline::casefile {
namespace {

TimeCase with(std::vector<IntervalCase> intervals) {
  TimeCase time;
  time.intervals = std::move(intervals);
  return time;
}

TEST(TimeSteps, OfOneSizeEndAsTheyAlwaysDid) {
  TimeCase time;
  time.end = 0.7;
  time.steps = 13;
  const TimeSteps steps(time);
  for (int n = 0; n <= 13; ++n)
    EXPECT_EQ(steps.at(n), 0.7 * n / 13);
  EXPECT_EQ(steps.size(5), 0.7 / 13);
  EXPECT_EQ(steps.sizes(13), 1);
}

TEST(TimeSteps, OfIntervalsHaveTheSizeOfTheirInterval) {
  const TimeSteps steps(with({{0.01, 100}, {1, 50}}));
  EXPECT_EQ(steps.count(), 150);
  EXPECT_DOUBLE_EQ(steps.size(100), 1e-4);
  EXPECT_DOUBLE_EQ(steps.size(101), 0.99 / 50);
  EXPECT_EQ(steps.at(0), 0);
  EXPECT_EQ(steps.at(100), 0.01);
  EXPECT_DOUBLE_EQ(steps.at(101), 0.01 + 0.99 / 50);
  EXPECT_EQ(steps.at(150), 1);
  EXPECT_EQ(steps.sizes(100), 1);
  EXPECT_EQ(steps.sizes(101), 2);
}

TEST(TimeSteps, AreFoundByTheTimeAtWhichTheyEnd) {
  const TimeSteps steps(with({{0.3, 3}, {0.300001, 7}, {100, 11}, {100.1, 1}}));
  for (int n = 1; n <= steps.count(); ++n) {
    EXPECT_EQ(steps.number(steps.at(n)), n);
    EXPECT_EQ(steps.before(steps.at(n)), steps.at(n - 1));
    EXPECT_NEAR(steps.at(n) - steps.at(n - 1), steps.size(n), 1e-12 * steps.at(n)) << n;
  }
}

TEST(TimeSteps, WhoseSizesDifferByRoundOffHaveOneSize) {
  const TimeSteps steps(with({{0.1, 10}, {0.2, 10}, {0.3, 10}, {1.3, 100}, {1.4, 9}}));
  EXPECT_EQ(steps.sizes(130), 1);
  EXPECT_EQ(steps.sizes(139), 2);
  EXPECT_EQ(steps.size(130), steps.size(1));
}

TEST(TimeSteps, OneIsTakenInTwoHalvesAndTheOthersEndWhereTheyDid) {
  const TimeSteps whole(with({{0.3, 3}, {1, 7}}));
  for (int n = 1; n <= whole.count(); ++n) {
    TimeSteps steps = whole;
    steps.halve(n);
    EXPECT_EQ(steps.count(), whole.count() + 1);
    for (int m = 1; m <= whole.count(); ++m)
      EXPECT_DOUBLE_EQ(steps.at(m < n ? m : m + 1), whole.at(m)) << n << ' ' << m;
    EXPECT_DOUBLE_EQ(steps.at(n), (whole.at(n - 1) + whole.at(n)) / 2);
    for (int m = 1; m <= steps.count(); ++m) {
      EXPECT_EQ(steps.number(steps.at(m)), m);
      EXPECT_EQ(steps.size(m), m == n || m == n + 1 ? whole.size(n) / 2 : whole.size(m - (m > n)));
    }
  }
}

TEST(TimeSteps, AHalfIsHalvedAgain) {
  TimeSteps steps(with({{1, 2}}));
  steps.halve(2);
  steps.halve(2);
  EXPECT_EQ(steps.count(), 4);
  EXPECT_DOUBLE_EQ(steps.at(2), 0.625);
  EXPECT_EQ(steps.size(3), 0.125);
  EXPECT_EQ(steps.size(4), 0.25);
  EXPECT_EQ(steps.sizes(4), 3);
}

}  // namespace
}  // namespace tourmaline::casefile
