#include "solve/calm_steps.h"

#include <gtest/gtest.h>

namespace tourmaline::solve {
namespace {

using Eigen::VectorXd;

// An unknown that answers too strongly beside one that answers slowly: the plain fixed point goes
// between the first one's ends for ever.
TEST(CalmSteps, ComeNearWhereAMapAnswersTooStrongly) {
  const auto map = [](const VectorXd &x) -> VectorXd {
    const double strong = x[0] < 0.3 ? 1 : 0, slow = x[1] + 0.1 * (2 - x[1]) + 0.01 * (x[0] - 0.3);
    return Eigen::Vector2d{strong, slow};
  };
  VectorXd x = VectorXd::Zero(2);
  CalmSteps calm;
  for (int k = 0; k < 200; ++k)
    x = calm.next(x, map(x));
  EXPECT_NEAR(x[0], 0.3, 1e-3);
  EXPECT_NEAR(x[1], 2, 1e-2);
}

TEST(CalmSteps, StayWhereTheMapDoes) {
  CalmSteps calm;
  const VectorXd x = VectorXd::Constant(3, 0.7);
  EXPECT_EQ(calm.next(x, x), x);
  EXPECT_EQ(calm.next(x, x), x);
}

}  // namespace
}  // namespace tourmaline::solve
