#include "solve/spring_path.h"

#include <gtest/gtest.h>

#include <vector>

namespace tourmaline::solve {
namespace {

TEST(SpringPath, EndsAtSpringsThatAreStifferThanTheBody) {
  std::vector<double> solved;
  EXPECT_TRUE(follow_springs([&](double stiffness) {
    solved.push_back(stiffness);
    return true;
  }));
  EXPECT_LE(solved.front(), 1e-12);
  EXPECT_EQ(solved.back(), 10);
  for (std::size_t k = 1; k < solved.size(); ++k) {
    EXPECT_GT(solved[k], solved[k - 1]);
    EXPECT_LE(solved[k], 10 * solved[k - 1] * (1 + 1e-12));
  }
}

// What can be solved is what is no more than twice as stiff as the last.
TEST(SpringPath, TakesShorterStepsWhereLongOnesCannotBeSolved) {
  double last = 0;
  int refused = 0;
  EXPECT_TRUE(follow_springs([&](double stiffness) {
    if (last > 1e-6 && last < 1e-4 && stiffness > 2 * last) {
      ++refused;
      return false;
    }
    EXPECT_GT(stiffness, last);
    last = stiffness;
    return true;
  }));
  EXPECT_EQ(last, 10);
  EXPECT_GT(refused, 1);
}

TEST(SpringPath, EndsWhereNoStepCanBeSolved) {
  int tries = 0;
  EXPECT_FALSE(follow_springs([&](double stiffness) { return ++tries, stiffness < 1e-7; }));
  EXPECT_LT(tries, 20);
}

}  // namespace
}  // namespace tourmaline::solve
