#include "contact/coulomb.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace tourmaline::contact {
namespace {

FrictionCoefficient constant(double mu) {
  return {mu, mu};
}

TEST(Coulomb, TheBoundIsCohesionAndPressureTimesTheCoefficient) {
  const FrictionBound::Value at = Coulomb(constant(0.3), 5).at(100, 1e-6);
  EXPECT_DOUBLE_EQ(at.bound, 35);
  EXPECT_DOUBLE_EQ(at.by_pressure, 0.3);
  EXPECT_EQ(at.by_slip, 0);
}

TEST(Coulomb, BeyondTheLimitThePressureDecidesNothing) {
  const Coulomb law({0.4, 0.2, 1e-3, 0, 1}, 5, 30);
  const FrictionBound::Value at = law.at(100, 1e-4);
  EXPECT_EQ(at.bound, 30);
  EXPECT_EQ(at.by_pressure, 0);
  EXPECT_EQ(at.by_slip, 0);
  EXPECT_LT(law.at(20, 1e-4).bound, 30);
}

TEST(Coulomb, WithoutPressureOnlyCohesionIsLeft) {
  EXPECT_EQ(Coulomb(constant(0.4), 5).at(0, 1e-4).bound, 5);
}

// As bilateral contact may be.
TEST(Coulomb, PulledItHasLessAndAtLeastNothing) {
  const Coulomb law(constant(0.25), 5);
  EXPECT_EQ(law.at(-8, 1e-4).bound, 3);
  EXPECT_EQ(law.at(-8, 1e-4).by_pressure, 0.25);
  const FrictionBound::Value none = law.at(-40, 1e-4);
  EXPECT_EQ(none.bound, 0);
  EXPECT_EQ(none.by_pressure, 0);
  EXPECT_EQ(none.by_slip, 0);
}

TEST(Coulomb, ALimitAtTheCohesionIsTrescasBound) {
  const Coulomb law(constant(0.3), 5, 5);
  for (const double p : {0., 1e-9, 1., 1e9})
    EXPECT_EQ(law.at(p, 1).bound, 5);
}

TEST(FrictionCoefficient, ItFallsFromRestToKineticByEulersNumberOverTheScale) {
  const FrictionCoefficient mu{0.5, 0.3, 1e-6, 0, 1};
  EXPECT_DOUBLE_EQ(mu.value(0), 0.5);
  EXPECT_NEAR(mu.value(1e-6), 0.3 + 0.2 / std::exp(1.), 1e-16);
  EXPECT_NEAR(mu.value(1), 0.3, 1e-16);
  EXPECT_DOUBLE_EQ(mu.derivative(0), -0.2e6);
}

// x = |d|/k of the rate, s of the accumulated slip.
TEST(FrictionCoefficient, SlipRateAndAccumulatedSlipAreMeasuredAlike) {
  const double k = 0.25, d = 3e-4;
  EXPECT_DOUBLE_EQ((FrictionCoefficient{0.5, 0.3, 1e-3, 0, 1 / k}).value(d),
                   0.3 + 0.2 * std::exp(-d / k / 1e-3));
  EXPECT_DOUBLE_EQ((FrictionCoefficient{0.5, 0.3, 1e-3, 2e-4, 1}).value(d),
                   0.3 + 0.2 * std::exp(-5e-4 / 1e-3));
}

TEST(FrictionCoefficient, OneThatGrowsMayBe) {
  const FrictionCoefficient mu{0.2, 0.4, 1, 0, 1};
  EXPECT_DOUBLE_EQ(mu.value(0), 0.2);
  EXPECT_NEAR(mu.value(50), 0.4, 1e-15);
  EXPECT_GT(mu.derivative(0), 0);
}

TEST(Coulomb, DerivativesEqualCentralDifferencesOnEachSmoothBranch) {
  std::mt19937 random(1);
  std::uniform_real_distribution<> share(0, 1);
  int limited = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    const FrictionCoefficient mu{share(random), share(random), 1e-3, 1e-3 * share(random),
                                 10 * share(random)};
    const double cohesion = 50 * share(random), limit = cohesion + 60 * share(random);
    const Coulomb law(mu, cohesion, limit);
    const double p = 200 * share(random) - 50, slip = 1e-3 * share(random);
    const double by_p = 1e-5, by_d = 1e-9;
    const FrictionBound::Value at = law.at(p, slip);
    const double free = cohesion + mu.value(slip) * p;
    if (std::abs(free) < 0.1 || std::abs(free - limit) < 0.1)
      continue;  // a kink
    limited += at.bound == limit;
    EXPECT_EQ(at.bound, std::clamp(free, 0., limit));
    EXPECT_LE(at.bound, limit);
    EXPECT_NEAR(at.by_pressure,
                (law.at(p + by_p, slip).bound - law.at(p - by_p, slip).bound) / (2 * by_p), 1e-8);
    EXPECT_NEAR(at.by_slip,
                (law.at(p, slip + by_d).bound - law.at(p, slip - by_d).bound) / (2 * by_d),
                1e-4 + 1e-6 * std::abs(at.by_slip));
  }
  EXPECT_GT(limited, 100);
}

}  // namespace
}  // namespace tourmaline::contact
