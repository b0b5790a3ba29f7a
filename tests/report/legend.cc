#include "report/legend.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "case/load_table.h"
#include "tourmaline/case/case.h"

namespace tourmaline::report {
namespace {

using casefile::Formula;
using testing::ElementsAre;

casefile::BoundaryCase entry(const std::string &on) {
  casefile::BoundaryCase boundary;
  boundary.on = {on};
  return boundary;
}

TEST(Legend, WhatIsSaidInSeveralEntriesIsGathered) {
  casefile::Case asked;
  asked.boundaries = {entry("top"), entry("top")};
  asked.boundaries[0].temperature = Formula(3.);
  asked.boundaries[1].displacement = {Formula(0.), std::nullopt};
  const Conditions conditions = conditions_on(asked, "top");
  EXPECT_EQ(conditions.kind, "displacement");
  EXPECT_THAT(conditions.texts, ElementsAre("u = (0, free) m", "θ = 3 K"));
}

TEST(Legend, ATableOfManyPointsIsTheirNumber) {
  casefile::LoadTable::Points points;
  for (int i = 0; i <= 3000; ++i)
    points.emplace_back(i * 1e-3, i);
  casefile::Case asked;
  asked.boundaries = {entry("top")};
  asked.boundaries[0].temperature =
      Formula(std::make_shared<const casefile::LoadTable>(std::move(points)));
  EXPECT_THAT(conditions_on(asked, "top").texts,
              ElementsAre("θ = (table of 3001 points, t = 0 to 3 s) K"));
}

TEST(Legend, NothingSaidIsFree) {
  const Conditions conditions = conditions_on({}, "top");
  EXPECT_EQ(conditions.kind, "free");
  EXPECT_TRUE(conditions.texts.empty());
}

TEST(Legend, ContactNamesItsLawsAndStaysContactBesideAPotential) {
  casefile::Case asked;
  asked.boundaries = {entry("left")};
  asked.boundaries[0].potential = Formula(0.);
  asked.contacts.emplace_back();
  asked.contacts.front().on = {"left"};
  asked.contacts.front().friction.law = "tresca";
  asked.contacts.front().friction.bound = Formula("10 + y");
  const Conditions conditions = conditions_on(asked, "left");
  EXPECT_EQ(conditions.kind, "contact");
  EXPECT_THAT(conditions.texts, ElementsAre("bilateral contact", "Tresca friction, S = 10 + y N/m²",
                                            "insulated, q·ν = 0", "φ = 0 V"));
}

TEST(Legend, ContactNamesTheConstantsOfItsLaws) {
  casefile::Case asked;
  asked.contacts.emplace_back();
  asked.contacts.front().on = {"left"};
  asked.contacts.front().gap = Formula("1e-6*y");
  asked.contacts.front().foundation_displacement = {Formula(0.), Formula("t")};
  asked.contacts.front().normal = {"compliance", Formula(1e13), 1.5};
  asked.contacts.front().friction.law = "coulomb";
  asked.contacts.front().friction.cohesion = Formula(2.);
  asked.contacts.front().friction.limit = Formula(30.);
  casefile::FrictionCoefficientCase &mu = asked.contacts.front().friction.coefficient;
  mu.at_rest = Formula(0.5);
  mu.kinetic = Formula("0.3 + y");
  mu.distance = 1e-6;
  EXPECT_THAT(
      conditions_on(asked, "left").texts,
      ElementsAre("compliance, p = c (u_ν − g)₊^1.5, c = 1·10¹³ N/m^3.5", "gap g = 1e-6*y m",
                  "foundation moves by (0, t) m",
                  "Coulomb friction, μ from 0.5 to 0.3 + y over 1·10⁻⁶ m of slip, cohesion 2 N/m², "
                  "at most 30 N/m²",
                  "insulated, q·ν = 0"));
}

TEST(Legend, ContactNamesItsNormalLaw) {
  casefile::Case asked;
  asked.contacts.emplace_back();
  asked.contacts.front().on = {"left"};
  asked.contacts.front().normal.law = "unilateral";
  asked.contacts.front().friction.law = "coulomb";
  asked.contacts.front().friction.coefficient.value = Formula(0.3);
  EXPECT_THAT(conditions_on(asked, "left").texts,
              ElementsAre("unilateral contact", "Coulomb friction, μ = 0.3", "insulated, q·ν = 0"));
  asked.contacts.front().normal = {"damped", Formula(1e9)};
  EXPECT_EQ(conditions_on(asked, "left").texts[0], "damped contact, c = 1·10⁹ N s/m³");
  asked.contacts.front().normal = {"compliance", Formula(2e13), 1};
  EXPECT_EQ(conditions_on(asked, "left").texts[0], "compliance, p = c (u_ν − g)₊, c = 2·10¹³ N/m³");
}

TEST(Legend, LawsOfAProgramStandInstead) {
  casefile::Case asked;
  asked.contacts.emplace_back();
  asked.contacts.front().on = {"left"};
  asked.contacts.front().friction.law = "tresca";
  asked.contacts.front().friction.bound = Formula(15.);
  EXPECT_THAT(conditions_on(asked, "left", "nap").texts,
              ElementsAre("bilateral contact", "friction of a program: nap", "insulated, q·ν = 0"));
}

TEST(Legend, AnElectrodeIsNamedWithItsCircuit) {
  casefile::Case asked;
  casefile::ElectrodeCase electrode;
  electrode.name = "signal";
  electrode.on = {"top"};
  electrode.resistor = 1e6;
  electrode.to = "ground";
  asked.electrodes = {electrode};
  asked.dimension = 3;
  EXPECT_THAT(conditions_on(asked, "top").texts,
              ElementsAre("electrode signal, 1000000 Ω, to ground"));
}

TEST(Legend, OfAPlaneBodyACircuitHoldsForAMetreOfDepth) {
  casefile::Case asked;
  casefile::ElectrodeCase electrode;
  electrode.name = "signal";
  electrode.on = {"top"};
  electrode.resistor = 1e6;
  electrode.capacitor = 1e-9;
  asked.electrodes = {electrode};
  asked.dimension = 2;
  EXPECT_THAT(conditions_on(asked, "top").texts,
              ElementsAre("electrode signal, 1000000 Ω m, 1e-09 F/m"));
}

}  // namespace
}  // namespace tourmaline::report
