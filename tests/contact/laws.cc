#include "contact/laws.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tourmaline/error.h"

namespace tourmaline::contact {
namespace {

using casefile::ContactCase;
using casefile::Formula;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr double k = 0.25;
const Vector3 place{1, 2, 3};

Formula formula(const std::string &text) {
  return Formula(text, "contact.key");
}

ContactCase coulomb(const std::string &mu, const std::string &cohesion = "0") {
  ContactCase asked;
  asked.friction.law = "coulomb";
  asked.friction.coefficient.value = formula(mu);
  asked.friction.cohesion = formula(cohesion);
  return asked;
}

ContactCase from_rest(double at_rest, double kinetic) {
  ContactCase asked;
  asked.friction.law = "coulomb";
  asked.friction.coefficient.at_rest = at_rest;
  asked.friction.coefficient.kinetic = kinetic;
  return asked;
}

ContactCase normal(const std::string &law, const std::string &coefficient, double exponent = 1) {
  ContactCase asked;
  asked.normal = {law, formula(coefficient), exponent};
  return asked;
}

double bound_at(const ContactCase &asked, double pressure, double slip = 0, double time = 0,
                double slipped = 0) {
  return ContactLaws(asked, k).bound(place, time, slipped)->at(pressure, slip).bound;
}

TEST(ContactLaws, ACoefficientIsThatOfThePlaceAndTheTime) {
  EXPECT_DOUBLE_EQ(bound_at(coulomb("x/10 + t", "y + t"), 100, 0, 0.5), 2.5 + 0.6 * 100);
}

TEST(ContactLaws, TheRateIsTheSlipOverTheStep) {
  ContactCase asked = from_rest(0.4, 0.2);
  asked.friction.coefficient.speed = 1e-3;
  EXPECT_DOUBLE_EQ(bound_at(asked, 100, 5e-4), 100 * (0.2 + 0.2 * std::exp(-5e-4 / k / 1e-3)));
  EXPECT_EQ(bound_at(asked, 100, 5e-4, 0, 7), bound_at(asked, 100, 5e-4));
  EXPECT_FALSE(ContactLaws(asked, k).remembers_slip());
}

TEST(ContactLaws, TheAccumulatedSlipHasThePresentStepsWithIt) {
  ContactCase asked = from_rest(0.5, 0.3);
  asked.friction.coefficient.distance = 1e-6;
  EXPECT_DOUBLE_EQ(bound_at(asked, 100, 2e-7, 0, 5e-7), 100 * (0.3 + 0.2 * std::exp(-0.7)));
  EXPECT_TRUE(ContactLaws(asked, k).remembers_slip());
}

TEST(ContactLaws, NegativeCoefficientsByFormulaAreToldWithKeyPlaceAndTime) {
  EXPECT_THAT([] { bound_at(coulomb("0.3 - t"), 1, 0, 0.5); },
              ThrowsMessage<CaseError>(AllOf(HasSubstr("contact.key"), HasSubstr("-0.2"),
                                             HasSubstr("(1, 2, 3)"), HasSubstr("0.5"),
                                             HasSubstr("friction coefficient"))));
  EXPECT_THAT([] { bound_at(coulomb("0.3", "1 - x - t"), 1, 0, 0.5); },
              ThrowsMessage<CaseError>(AllOf(HasSubstr("cohesion"), HasSubstr("-0.5"))));
  ContactCase asked = from_rest(-0.1, 0.2);
  asked.friction.coefficient.speed = 1;
  EXPECT_THAT([&] { bound_at(asked, 1); }, ThrowsMessage<CaseError>(HasSubstr("static")));
  asked = from_rest(0.1, -0.2);
  asked.friction.coefficient.distance = 1;
  EXPECT_THAT([&] { bound_at(asked, 1); }, ThrowsMessage<CaseError>(HasSubstr("kinetic")));
}

TEST(ContactLaws, CoefficientsThatAreNoNumbersAreRefused) {
  EXPECT_THROW(bound_at(coulomb("sqrt(-1 - t)"), 1), Error);
  EXPECT_THROW(bound_at(coulomb("1/(t - 0.5)"), 1, 0, 0.5), Error);
  EXPECT_THROW(ContactLaws(normal("compliance", "0/(x - 1)"), k).normal(place, 0), Error);
}

TEST(ContactLaws, ALimitIsNotBelowTheCohesion) {
  ContactCase asked = coulomb("0.5", "10*t");
  asked.friction.limit = formula("20 - 10*t");
  EXPECT_DOUBLE_EQ(bound_at(asked, 1e9, 0, 0.5), 15);
  EXPECT_DOUBLE_EQ(bound_at(asked, 1e9, 0, 1), 10);
  EXPECT_THAT([&] { bound_at(asked, 1, 0, 1.5); },
              ThrowsMessage<CaseError>(AllOf(HasSubstr("limit"), HasSubstr("cohesion"))));
  EXPECT_DOUBLE_EQ(bound_at(coulomb("0.5"), 1e9), 5e8);
}

TEST(ContactLaws, FrictionOfOtherLawsHasNoBoundThatDependsOnThePressure) {
  for (const char *law : {"none", "tresca"}) {
    ContactCase asked;
    asked.friction.law = law;
    asked.friction.bound = 7.;
    EXPECT_EQ(ContactLaws(asked, k).bound(place, 0, 0), nullptr);
    EXPECT_EQ(std::get<Tresca>(ContactLaws(asked, k).friction()({place, 0, {}})).bound,
              asked.friction.law == "tresca" ? 7 : 0);
  }
  // Coulomb's own ball is that of the bound alone.
  EXPECT_EQ(std::get<Tresca>(ContactLaws(coulomb("1"), k).friction()({place, 0, {}})).bound, 0);
}

TEST(ContactLaws, NormalLawsHaveTheNumbersOfTheCase) {
  EXPECT_DOUBLE_EQ(ContactLaws(normal("compliance", "10*x", 2), k).normal(place, 9)->pressure_at(2),
                   40);
  EXPECT_DOUBLE_EQ(ContactLaws(normal("damped", "10*x"), k).normal(place, 1.5)->pressure_at(2),
                   10 / k * 0.5);
  EXPECT_EQ(ContactLaws(normal("unilateral", "0"), k).normal(place, 0)->pressure(-1, 1), 0);
  EXPECT_EQ(ContactLaws(normal("bilateral", "0"), k).normal(place, 0)->pressure(-1, 1), -1);
}

TEST(ContactLaws, CoefficientsOfNormalLawsArePositive) {
  for (const char *law : {"compliance", "damped"})
    for (const char *coefficient : {"x - 1", "-x"})
      EXPECT_THAT([&] { ContactLaws(normal(law, coefficient), k).normal(place, 0); },
                  ThrowsMessage<CaseError>(AllOf(HasSubstr("contact.key"), HasSubstr("> 0"))));
}

/// What a pair of laws asks of a route.
struct Needs {
  bool normal_unknowns, opens, coupled;
};

Needs needs(const std::string &law, const std::string &friction, bool is_replaced = false) {
  ContactCase asked = normal(law, "1");
  asked.friction.law = friction;
  ContactLaws laws(asked, k);
  if (is_replaced)
    laws.replace_friction();
  return {laws.has_normal_unknowns(), laws.can_open(), laws.friction_depends_on_pressure()};
}

void expect_needs(const Needs &found, const Needs &wanted) {
  EXPECT_EQ(found.normal_unknowns, wanted.normal_unknowns);
  EXPECT_EQ(found.opens, wanted.opens);
  EXPECT_EQ(found.coupled, wanted.coupled);
}

TEST(ContactLaws, ARouteIsAskedForNoMoreThanThePairOfLawsNeeds) {
  for (const char *friction : {"none", "tresca"})
    expect_needs(needs("bilateral", friction), {false, false, false});
  expect_needs(needs("bilateral", "coulomb"), {true, false, true});
  for (const char *law : {"unilateral", "compliance", "damped"}) {
    SCOPED_TRACE(law);
    expect_needs(needs(law, "none"), {true, true, false});
    expect_needs(needs(law, "tresca"), {true, true, true});
    expect_needs(needs(law, "coulomb"), {true, true, true});
  }
}

TEST(ContactLaws, AProgramsOwnFrictionTakesThePlaceOfTheCases) {
  expect_needs(needs("bilateral", "coulomb", true), {false, false, false});
  expect_needs(needs("unilateral", "none", true), {true, true, true});
  ContactLaws laws(coulomb("0.5"), k);
  laws.replace_friction();
  EXPECT_EQ(laws.bound(place, 0, 0), nullptr);
}

TEST(ContactLaws, TheFoundationMovesByAFormulaForEachAxis) {
  ContactCase asked;
  EXPECT_FALSE(ContactLaws(asked, k).has_moving_foundation());
  EXPECT_EQ(ContactLaws(asked, k).foundation(place, 5), (Vector3{}));
  asked.foundation_displacement = {formula("x*t"), formula("-2*t")};
  const ContactLaws laws(asked, k);
  EXPECT_TRUE(laws.has_moving_foundation());
  EXPECT_EQ(laws.foundation(place, 0.5), (Vector3{0.5, -1, 0}));
}

TEST(ContactLaws, TheGapIsAFormulaOfThePlaceOfEitherSign) {
  ContactCase asked;
  asked.gap = formula("0.1*x - 0.2*y");
  EXPECT_DOUBLE_EQ(ContactLaws(asked, k).gap(place), -0.3);
}

}  // namespace
}  // namespace tourmaline::contact
