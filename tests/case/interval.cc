#include "case/interval.h"

#include <gtest/gtest.h>

#include "tourmaline/error.h"

namespace tourmaline::casefile {
namespace {

TEST(Interval, IsANumberOfStepsOrATime) {
  EXPECT_EQ(interval("10 steps").steps, 10);
  EXPECT_EQ(interval("1 step").steps, 1);
  EXPECT_EQ(interval("30 s").seconds, 30);
  EXPECT_EQ(interval("5 min").seconds, 300);
  EXPECT_EQ(interval("1.5h").seconds, 5400);
  EXPECT_EQ(interval("10 steps").seconds, 0);
  EXPECT_EQ(interval("30 s").steps, 0);
}

TEST(Interval, OfNeverIsNone) {
  EXPECT_EQ(interval("never").steps, 0);
  EXPECT_EQ(interval("never").seconds, 0);
}

TEST(Interval, IsRefusedWithoutUnitOrMeaning) {
  for (const char *text : {"", "10", "min", "0 steps", "-5 min", "1.5 steps", "5 minutes", "nan s",
                           "inf h", "3000000000 steps", "5 min ago"}) {
    EXPECT_NE(interval_complaint(text), "") << text;
    EXPECT_THROW(interval(text), CaseError) << text;
  }
}

}  // namespace
}  // namespace tourmaline::casefile
