#include "contact/exchange.h"

#include <gtest/gtest.h>

#include <random>

#include "contact/charge_exchange.h"
#include "contact/heat_exchange.h"
#include "contact/laws.h"

namespace tourmaline::contact {
namespace {

/// Central differences of the flow against the derivatives that the law says.
void expect_derivatives(const Exchange &law, double value, const ContactState &state) {
  const auto slope = [&](auto move, double size) {
    double at[2];
    for (const int side : {0, 1}) {
      double moved = value;
      ContactState there = state;
      move(moved, there, (side == 0 ? -1 : 1) * size);
      at[side] = law.at(moved, there).flow;
    }
    return (at[1] - at[0]) / (2 * size);
  };
  const Exchange::Value is = law.at(value, state);
  const auto expect = [](double derivative, double difference) {
    EXPECT_NEAR(derivative, difference, 1e-6 * std::abs(derivative) + 1e-12);
  };
  expect(is.by_value, slope([](double &v, ContactState &, double h) { v += h; }, 1e-2));
  expect(is.by_pressure, slope([](double &, ContactState &s, double h) { s.pressure += h; }, 5));
  expect(is.by_penetration,
         slope([](double &, ContactState &s, double h) { s.penetration += h; }, 1e-11));
  expect(is.by_friction, slope([](double &, ContactState &s, double h) { s.friction += h; }, 1e-3));
}

HeatExchange heat() {
  HeatExchange::Parameters is;
  is.faded = 2e3;
  is.ramp = Ramp(3e-7);
  is.by_pressure = {5e3, 1e5, 0.95};
  is.foundation = -7;
  is.friction_share = 0.5 / 1e-2;
  return HeatExchange(is);
}

TEST(HeatExchange, DerivativesAreThoseOfDifferences) {
  const HeatExchange law = heat();
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform;
  for (int k = 0; k < 50; ++k)
    expect_derivatives(
        law, 40 * uniform(random) - 20,
        {2e5 * uniform(random) + 1e4, -2.9e-7 * uniform(random) - 1e-9, 10 * uniform(random)});
}

TEST(HeatExchange, TheConstantPartFadesWithTheGapAndThePressuresDoesNot) {
  const HeatExchange law = heat();
  EXPECT_DOUBLE_EQ(law.at(3, {0, 0, 0}).flow, 2e3 * 10);
  EXPECT_DOUBLE_EQ(law.at(3, {0, 1e-6, 0}).flow, 2e3 * 10);
  EXPECT_DOUBLE_EQ(law.at(3, {0, -1.5e-7, 0}).flow, 1e3 * 10);
  EXPECT_EQ(law.at(3, {0, -3e-7, 0}).flow, 0);
  EXPECT_EQ(law.at(3, {0, -1, 0}).flow, 0);
  EXPECT_DOUBLE_EQ(law.at(3, {1e5, 0, 0}).flow, 7e3 * 10);
}

// As bilateral contact may be.
TEST(HeatExchange, OfAContactThatIsPulledThePressureBringsNothing) {
  const Exchange::Value at = heat().at(3, {-1e5, 0, 0});
  EXPECT_DOUBLE_EQ(at.flow, 2e3 * 10);
  EXPECT_EQ(at.by_pressure, 0);
}

TEST(HeatExchange, FrictionBringsItsShareIntoTheBodyWhateverElseFlows) {
  const Exchange::Value at = heat().at(-7, {1e5, 0, 4});
  EXPECT_DOUBLE_EQ(at.flow, -0.5 * 4 / 1e-2);
}

TEST(ChargeExchange, DerivativesAreThoseOfDifferences) {
  ChargeExchange::Parameters is;
  is.coefficient = 1e-6;
  is.ramp = Ramp(1e-7);
  is.foundation = 3;
  is.before = 2e-6;
  for (const double penetration : {-2e-7, -9e-8, -3e-8, 5e-8})
    expect_derivatives(ChargeExchange(is), 20, {0, penetration, 0});
}

TEST(ChargeExchange, WhatHasLeakedStaysWhereTheContactIsOpen) {
  ChargeExchange::Parameters is;
  is.coefficient = 1e-6;
  is.ramp = Ramp(1e-7);
  is.before = 2e-6;
  EXPECT_EQ(ChargeExchange(is).at(100, {0, -2e-7, 0}).flow, 2e-6);
  EXPECT_DOUBLE_EQ(ChargeExchange(is).at(100, {0, 0, 0}).flow, 2e-6 + 1e-4);
}

casefile::ContactCase exchanging() {
  casefile::ContactCase asked;
  asked.on = {"left"};
  asked.heat.law = "exchange";
  asked.heat.coefficient = 5;
  return asked;
}

TEST(ContactLaws, ALinearExchangeIsTheOperators) {
  const ContactLaws laws(exchanging(), 0.1);
  EXPECT_FALSE(laws.crosses_by_state(Crossing::heat));
  ASSERT_TRUE(laws.linear(Crossing::heat));
  EXPECT_EQ(laws.linear(Crossing::heat)->coefficient.value({}, 0), 5);
  EXPECT_EQ(laws.exchange(Crossing::heat, {}, 0, 0), nullptr);
}

TEST(ContactLaws, AConstantPartBesideThePressuresStaysTheOperatorsUnlessItFades) {
  casefile::ContactCase asked = exchanging();
  asked.heat.pressure = {100, 1e5, 1};
  const ContactLaws constant(asked, 0.1);
  ASSERT_TRUE(constant.linear(Crossing::heat));
  EXPECT_DOUBLE_EQ(constant.exchange(Crossing::heat, {}, 0, 0)->at(1, {1e5, 0, 0}).flow, 100);
  asked.heat.ramp = 1e-7;
  const ContactLaws fading(asked, 0.1);
  EXPECT_FALSE(fading.linear(Crossing::heat));
  EXPECT_DOUBLE_EQ(fading.exchange(Crossing::heat, {}, 0, 0)->at(1, {1e5, 0, 0}).flow, 105);
}

TEST(ContactLaws, FrictionThatThereIsNoneOfWarmsNothing) {
  casefile::ContactCase asked;
  asked.heat.friction_share = 0.5;
  EXPECT_FALSE(ContactLaws(asked, 0.1).crosses_by_state(Crossing::heat));
  asked.friction.law = "tresca";
  EXPECT_TRUE(ContactLaws(asked, 0.1).crosses_by_state(Crossing::heat));
}

}  // namespace
}  // namespace tourmaline::contact
