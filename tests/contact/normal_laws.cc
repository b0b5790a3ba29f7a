#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>

#include "contact/compliance.h"
#include "contact/damped.h"
#include "contact/held_normal.h"
#include "contact/local_law.h"
#include "contact/unilateral.h"
#include "contact/yosida_normal.h"
#include "tangents.h"

namespace tourmaline::contact {
namespace {

/// A point of a law's graph.
struct Answer {
  double delta, pressure;
};

/// A law with its graph, written out without the law's own functions, and where the slope of its
/// resolvent jumps: at p + r delta = r `start`.
struct Case {
  std::string name;
  std::shared_ptr<const NormalLaw> law;
  std::function<Answer(std::mt19937 &)> answer;
  double start = 0;
};

double decades(std::mt19937 &random, double from, double to) {
  return std::pow(10., std::uniform_real_distribution<>(from, to)(random));
}

bool toss(std::mt19937 &random) {
  return random() % 2 == 0;
}

Case held() {
  return {"bilateral", std::make_shared<HeldNormal>(), [](std::mt19937 &random) {
            return Answer{0, (toss(random) ? 1 : -1) * decades(random, -9, 9)};
          }};
}

Case unilateral() {
  return {"unilateral", std::make_shared<Unilateral>(), [](std::mt19937 &random) {
            return toss(random) ? Answer{-decades(random, -15, 0), 0}
                                : Answer{0, decades(random, -9, 9)};
          }};
}

// Penetrations at which the pressure is a number that means something.
Case compliance(double c, double m) {
  return {"compliance c = " + std::to_string(std::log10(c)) + " decades, m = " + std::to_string(m),
          std::make_shared<Compliance>(c, m), [=](std::mt19937 &random) {
            if (toss(random))
              return Answer{-decades(random, -15, 0), 0};
            const double p = decades(random, -9, 9), delta = std::pow(p / c, 1 / m);
            return Answer{delta, c * std::pow(delta, m)};
          }};
}

Case damped(double c, double k, double before) {
  const double start = std::max(before, 0.);
  return {
      "damped c = " + std::to_string(std::log10(c)) + " decades, before " + std::to_string(before),
      std::make_shared<Damped>(c, k, before),
      [=](std::mt19937 &random) {
        if (toss(random))
          return Answer{start - decades(random, -15, 0), 0};
        const double p = decades(random, -9, 9);
        return Answer{start + p * k / c, p};
      },
      start};
}

// The spring's own way in is added to the law's.
Case behind_spring(const Case &own, double c) {
  return {own.name + " behind a spring of " + std::to_string(std::log10(c)) + " decades",
          std::make_shared<YosidaNormal>(own.law, c), [=](std::mt19937 &random) {
            const Answer at = own.answer(random);
            return Answer{at.delta + at.pressure / c, at.pressure};
          }};
}

std::vector<Case> all_laws() {
  std::vector<Case> laws{held(), unilateral()};
  for (const double m : {1., 1.5, 2., 3.33, 5.})
    for (const double c : {1e-10, 1., 1e13, 1e40})
      laws.push_back(compliance(c, m));
  for (const double before : {-1e-3, 0., 1e-9, 1.})
    for (const double c : {1e-6, 1e9})
      laws.push_back(damped(c, 1e-3, before));
  for (const double c : {1e-3, 1e6, 1e15}) {
    laws.push_back(behind_spring(unilateral(), c));
    laws.push_back(behind_spring(compliance(1e13, 1.5), c));
  }
  return laws;
}

class NormalLaws : public ::testing::Test {
 protected:
  template <class Check>
  void for_all(Check &&check) {
    for (const Case &c : all_laws()) {
      SCOPED_TRACE(c.name);
      std::mt19937 random(1);
      for (int k = 0; k < 300 && !HasFailure(); ++k) {
        const double r = decades(random, -6, 20);
        SCOPED_TRACE(r);
        check(c, r, random);
      }
    }
  }
};

// What p + r delta loses to round-off, carried to the pressure by the resolvent's slope.
double round_off(const Case &c, const Answer &at, double r) {
  const double lost = 4e-16 * (std::abs(at.pressure) + r * (std::abs(at.delta) + c.start));
  const double slope = c.law->pressure_derivative(at.pressure + r * at.delta + lost, r);
  return 3 * slope * lost + 4e-15 * std::abs(at.pressure);
}

TEST_F(NormalLaws, ThePressureIsTheOnlyOneThatBelongsToTheTrialValue) {
  for_all([](const Case &c, double r, std::mt19937 &random) {
    const Answer at = c.answer(random);
    EXPECT_NEAR(c.law->pressure(at.pressure + r * at.delta, r), at.pressure, round_off(c, at, r))
        << at.delta;
  });
}

// What is left of the trial value is r delta: for any trial value the answer lies on the graph.
TEST_F(NormalLaws, ForAnyTrialValueTheAnswerLiesOnTheGraph) {
  for_all([](const Case &c, double r, std::mt19937 &random) {
    const double y = (toss(random) ? 1 : -1) * decades(random, -9, 12);
    const double p = c.law->pressure(y, r), delta = (y - p) / r;
    if (c.law->is_smooth_at(delta)) {
      // The rest is found as well as y - p has digits.
      const double lost = 1e-15 * (std::abs(y) / r + c.start);
      EXPECT_NEAR(c.law->pressure_at(delta), p,
                  1e-12 * std::abs(p) + 4 * lost * (c.law->stiffness_at(delta + lost)));
    } else {
      EXPECT_EQ(delta, 0);
      EXPECT_GE(p, c.law->potential(-1) == 0 ? 0 : -HUGE_VAL);
    }
  });
}

TEST_F(NormalLaws, TheResolventGrowsAndNeverFasterThanItsArgument) {
  for_all([](const Case &c, double r, std::mt19937 &random) {
    const double a = (toss(random) ? 1 : -1) * decades(random, -9, 12);
    const double b = toss(random) ? a * (1 + decades(random, -9, 0)) : decades(random, -9, 12);
    const double low = std::min(a, b), high = std::max(a, b);
    const double change = c.law->pressure(high, r) - c.law->pressure(low, r);
    const double lost = 4e-15 * (std::abs(a) + std::abs(b) + r * c.start);
    EXPECT_GE(change, -lost);
    EXPECT_LE(change, high - low + lost);
    for (const double y : {a, b}) {
      EXPECT_GE(c.law->pressure_derivative(y, r), 0);
      EXPECT_LE(c.law->pressure_derivative(y, r), 1);
    }
  });
}

TEST_F(NormalLaws, TheDerivativeIsThatOfTheResolvent) {
  for_all([](const Case &c, double r, std::mt19937 &random) {
    const double kink = r * c.start, y = kink + (toss(random) ? 1 : -1) * decades(random, -3, 9);
    const double h = 1e-5 * std::abs(y - kink);
    if (h < 1e-10 * std::abs(y))
      return;  // round-off is all that the difference has
    const double difference = (c.law->pressure(y + h, r) - c.law->pressure(y - h, r)) / (2 * h);
    EXPECT_NEAR(c.law->pressure_derivative(y, r), difference, 1e-8 + 1e-15 * std::abs(y) / h);
  });
}

TEST_F(NormalLaws, PressureAndStiffnessAreDerivativesOfThePotential) {
  for_all([](const Case &c, double, std::mt19937 &random) {
    const Answer at = c.answer(random);
    const double h = 1e-5 * std::abs(at.delta - c.start);
    if (!c.law->is_smooth_at(at.delta) || h < 1e-9 * std::abs(at.delta))
      return;
    const NormalLaw &law = *c.law;
    const double low = at.delta - h, high = at.delta + h, p = law.pressure_at(at.delta);
    EXPECT_NEAR((law.potential(high) - law.potential(low)) / (2 * h), p, 1e-6 * p);
    EXPECT_NEAR((law.pressure_at(high) - law.pressure_at(low)) / (2 * h),
                law.stiffness_at(at.delta), 1e-6 * law.stiffness_at(at.delta));
  });
}

TEST_F(NormalLaws, NothingIsPressedWhereAGapIsOpenUnlessTheContactIsBilateral) {
  for_all([](const Case &c, double r, std::mt19937 &random) {
    const double delta = -decades(random, -15, 3);
    if (!c.law->is_smooth_at(delta))
      return;
    EXPECT_EQ(c.law->pressure_at(delta), 0);
    EXPECT_EQ(c.law->potential(delta), 0);
    EXPECT_EQ(c.law->stored(delta), 0);
    EXPECT_EQ(c.law->dissipated(delta), 0);
    EXPECT_EQ(c.law->pressure(r * delta, r), 0);
    EXPECT_FALSE(c.law->is_closed(r * delta));
  });
}

TEST(HeldNormal, ItTouchesWithPressuresOfEitherSign) {
  const HeldNormal law;
  EXPECT_TRUE(law.is_closed(-1));
  EXPECT_EQ(law.pressure(-3, 7), -3);
  EXPECT_EQ(law.potential(0), 0);
  EXPECT_EQ(law.potential(-1e-300), HUGE_VAL);
  EXPECT_TRUE(law.has_kink());
}

TEST(Unilateral, TheBodyDoesNotEnter) {
  const Unilateral law;
  EXPECT_EQ(law.potential(0), 0);
  EXPECT_EQ(law.potential(1e-300), HUGE_VAL);
  EXPECT_TRUE(law.is_closed(0));
  EXPECT_FALSE(law.is_smooth_at(0));
  EXPECT_TRUE(law.has_kink());
}

TEST(Compliance, AllWorkIsStored) {
  // c delta^3 / 3 with p = c delta^2.
  const Compliance law(12, 2);
  EXPECT_DOUBLE_EQ(law.pressure_at(0.5), 3);
  EXPECT_DOUBLE_EQ(law.stored(0.5), 0.5);
  EXPECT_EQ(law.dissipated(0.5), 0);
  EXPECT_FALSE(law.has_kink());
  // 12 delta^2 + 2 delta = 4 at delta = 1/2.
  EXPECT_DOUBLE_EQ(law.pressure(4, 2), 3);
}

TEST(Compliance, NumbersAtTheEndOfTheirRangeDoNoHarm) {
  for (const double m : {1., 2., 5.})
    for (const double y : {1e-300, 5e-324, 1e30, 0., -0.})
      for (const double r : {1e-30, 1., 1e30})
        for (const double c : {1e-100, 1., 1e100}) {
          const double p = Compliance(c, m).pressure(y, r);
          EXPECT_TRUE(p >= 0 && p <= y) << m << ' ' << y << ' ' << r << ' ' << c << ' ' << p;
          const double slope = Compliance(c, m).pressure_derivative(y, r);
          EXPECT_TRUE(slope >= 0 && slope <= 1) << m << ' ' << y << ' ' << r << ' ' << c;
        }
}

TEST(Damped, AllWorkOfTheStepIsLostAndNoneIsGivenBack) {
  // c / k = 8 N/m^3, from 1/4 m to 1/2 m.
  const Damped law(4, 0.5, 0.25);
  EXPECT_DOUBLE_EQ(law.pressure_at(0.5), 2);
  EXPECT_DOUBLE_EQ(law.dissipated(0.5), 0.5);
  EXPECT_EQ(law.stored(0.5), 0);
  // On the way back it yields no pressure.
  EXPECT_EQ(law.pressure_at(0.2), 0);
  EXPECT_EQ(law.dissipated(0.2), 0);
  EXPECT_TRUE(law.is_closed(0.2 * 3));
}

TEST(Damped, FromAnOpenGapThePressureBeginsAtTheFoundation) {
  EXPECT_DOUBLE_EQ(Damped(4, 0.5, -7).pressure_at(0.5), 4);
}

// A body that only the contact holds would be loose at the start otherwise.
TEST_F(NormalLaws, TouchingIsPressing) {
  constexpr double r = 3e11;
  EXPECT_EQ(Unilateral().pressure_derivative(0, r), 1);
  EXPECT_EQ(Compliance(1e11, 1).pressure_derivative(0, r), 0.25);
  EXPECT_EQ(Damped(1e11, 1, 0).pressure_derivative(0, r), 0.25);
}

TEST(YosidaNormal, IsAFoundationThatYieldsWhereTheLawBehindDoesNot) {
  const YosidaNormal unilateral(std::make_shared<Unilateral>(), 12);
  EXPECT_EQ(unilateral.pressure_at(0.5), 6);
  EXPECT_EQ(unilateral.potential(0.5), 1.5);
  EXPECT_EQ(unilateral.pressure_at(-0.5), 0);
  EXPECT_FALSE(unilateral.has_kink());
  const YosidaNormal held(std::make_shared<HeldNormal>(), 12);
  EXPECT_EQ(held.pressure_at(-0.5), -6);
  EXPECT_TRUE(held.is_closed(-1));
  // Two springs in a row, of 12 and 4.
  const YosidaNormal compliance(std::make_shared<Compliance>(4, 1), 12);
  EXPECT_DOUBLE_EQ(compliance.pressure_at(0.5), 1.5);
  EXPECT_DOUBLE_EQ(compliance.potential(0.5), 0.375);
}

TEST(LocalLaw, OnlyANormalLawStandsBehindASpring) {
  const LocalLaw normal = NormalPoint(std::make_shared<Unilateral>());
  EXPECT_TRUE(normal.has_kink(1));
  EXPECT_FALSE(normal.behind_spring(1).has_kink(1));
  const LocalLaw friction = tourmaline::contact::Tresca{3};
  EXPECT_DOUBLE_EQ(friction.behind_spring(1).potential(along(2)), 6);
}

TEST(LocalLaw, ANormalLawIsALawOfOneComponentThatHoldsNoSlip) {
  const LocalLaw law = NormalPoint(std::make_shared<Compliance>(12, 2));
  EXPECT_DOUBLE_EQ(law.traction(along(4), 2)[0], 3);
  // stiffness 2 c delta = 12
  EXPECT_DOUBLE_EQ(law.traction_derivative(along(4), 2)(0, 0), 12. / 14);
  EXPECT_DOUBLE_EQ(law.gradient(along(0.5))[0], 3);
  EXPECT_DOUBLE_EQ(law.hessian(along(0.5))(0, 0), 12);
  EXPECT_DOUBLE_EQ(law.potential(along(0.5)), 0.5);
  EXPECT_EQ(law.status(along(4), 2), ContactStatus::stick);
  EXPECT_EQ(law.status(along(-4), 2), ContactStatus::open);
  EXPECT_EQ(law.held().size(), 0);
  EXPECT_FALSE(law.has_kink(1));
  EXPECT_FALSE(law.has_bend(1));
  EXPECT_NE(law.normal(), nullptr);
  EXPECT_EQ(LocalLaw(Tresca{1}).normal(), nullptr);
}

}  // namespace
}  // namespace tourmaline::contact
