#include "tourmaline/contact/tresca.h"

#include <gtest/gtest.h>

#include <random>

#include "tangents.h"

namespace tourmaline::contact {
namespace {

TEST(Tresca, BelowTheBoundAPointSticksAndCarriesTheTrialValue) {
  const Tresca law{15};
  EXPECT_EQ(law.status(along(14.9)), ContactStatus::stick);
  EXPECT_EQ(law.traction(along(-14.9))[0], -14.9);
}

TEST(Tresca, BeyondTheBoundAPointSlipsAndCarriesTheBoundAlongTheTrialValue) {
  const Tresca law{15};
  EXPECT_EQ(law.status(along(-16)), ContactStatus::slip);
  EXPECT_EQ(law.traction(along(-16))[0], -15);
  const Tangent lambda = law.traction(plane(30, 40));
  EXPECT_DOUBLE_EQ(lambda[0], 9);
  EXPECT_DOUBLE_EQ(lambda[1], 12);
}

TEST(Tresca, AtTheBoundWithoutSlipAPointSticks) {
  const Tresca law{5};
  EXPECT_EQ(law.status(plane(3, 4)), ContactStatus::stick);
  EXPECT_TRUE(law.traction_derivative(plane(3, 4)).isIdentity(0));
}

TEST(Tresca, WithBoundZeroNothingIsCarriedAndEverySlipIsSmooth) {
  const Tresca law{0};
  EXPECT_TRUE(law.traction(plane(3, 4)).isZero(0));
  EXPECT_TRUE(law.is_smooth_at(plane(0, 0)));
  EXPECT_TRUE(law.gradient(plane(0, 0)).isZero(0));
}

TEST(Tresca, ScalingTractionsAndBoundTogetherScalesTheAnswer) {
  const Tangent x = plane(-7, 2);
  EXPECT_TRUE((3 * Tresca{5}.traction(x)).isApprox(Tresca{15}.traction(3 * x), 1e-15));
}

TEST(Tresca, TheDissipationIsTheBoundTimesTheSlipAndNeverNegative) {
  EXPECT_DOUBLE_EQ(Tresca{15}.dissipation(plane(-3, 4)), 75);
  EXPECT_EQ(Tresca{15}.dissipation(plane(0, 0)), 0);
}

TEST(Tresca, TheTractionOpposesTheSlip) {
  // lambda = -sigma_tau points along the slip, so sigma_tau does work against it.
  const Tangent d = plane(1e-9, -2e-9);
  EXPECT_NEAR(Tresca{15}.gradient(d).dot(d), Tresca{15}.dissipation(d), 1e-22);
}

TEST(Tresca, TheDerivativesEqualCentralDifferencesOnEachSmoothBranch) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  const Tresca law{1};
  for (int trial = 0; trial < 200; ++trial) {
    const Tangent x = plane(2 * normal(random), 2 * normal(random));
    if (std::abs(x.norm() - 1) < 1e-2 || x.norm() < 1e-1)
      continue;  // the kink, or where the curvature spoils the difference
    for (int c = 0; c < 2; ++c) {
      const double h = 1e-6;
      const Tangent step = h * Tangent::Unit(2, c);
      const Tangent traction = (law.traction(x + step) - law.traction(x - step)) / (2 * h);
      EXPECT_LT((law.traction_derivative(x).col(c) - traction).norm(), 1e-8);
      const Tangent gradient = (law.gradient(x + step) - law.gradient(x - step)) / (2 * h);
      EXPECT_LT((law.hessian(x).col(c) - gradient).norm(), 1e-7);
      const double dissipation = (law.dissipation(x + step) - law.dissipation(x - step)) / (2 * h);
      EXPECT_NEAR(law.gradient(x)[c], dissipation, 1e-8);
    }
  }
}

}  // namespace
}  // namespace tourmaline::contact
