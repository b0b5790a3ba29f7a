#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "error_in.h"
#include "example.h"

namespace tourmaline::casefile {
namespace {

using testing::HasSubstr;

// What is wrong with the example after the overrides.
std::string error_of(const std::vector<std::string> &overrides) {
  return error_in(example, overrides);
}

TEST(Conflicts, OneFieldMayHaveOneConditionOnABoundary) {
  const std::string error = error_of({"boundary[3]={on='right', potential=5}"});
  EXPECT_THAT(error, HasSubstr("[boundary[3]] potential = 5"));
  EXPECT_THAT(error, HasSubstr("\"right\" has already a condition on the potential"));
  EXPECT_THAT(error, HasSubstr("case.toml:17:13 [boundary[0]] potential = 0"));
}

TEST(Conflicts, TheSameConditionTwiceIsStillTwo) {
  EXPECT_THAT(error_of({"boundary[3]={on='top', temperature=0}"}), HasSubstr("has already"));
  EXPECT_THAT(error_of({"boundary[3]={on='right', displacement=[0,'free']}"}),
              HasSubstr("has already a condition on the x component"));
}

TEST(Conflicts, PotentialAndChargeExcludeEachOther) {
  EXPECT_THAT(error_of({"boundary[0].surface_charge=0"}),
              HasSubstr("has already a condition on the potential or surface charge"));
}

TEST(Conflicts, TemperatureAndHeatFlowExcludeEachOther) {
  EXPECT_THAT(error_of({"boundary[1].heat_flux=1"}),
              HasSubstr("\"bottom\" has already a condition on the temperature or heat flow"));
}

TEST(Conflicts, TractionAgainstAFixedComponentIsAnError) {
  EXPECT_THAT(error_of({"boundary[1].displacement=['free',0]"}),
              HasSubstr("\"top\" has already a condition on the y component"));
}

TEST(Conflicts, AZeroTractionBesideAFixedComponentIsNone) {
  EXPECT_EQ(error_of({"boundary[2].displacement=[0,'free']"}), "no error");
}

TEST(Conflicts, TwoTractionsOnOneBoundaryAreAnError) {
  EXPECT_THAT(error_of({"boundary[3]={on='top', traction=[1,0]}"}),
              HasSubstr("has already a condition on the traction"));
}

TEST(Conflicts, TwoEntriesMayFixDifferentComponents) {
  EXPECT_EQ(error_of({"boundary[0].displacement=[0,'free']",
                      "boundary[3]={on='right', displacement=['free',0]}"}),
            "no error");
}

TEST(Conflicts, ContactOnAClampedBoundaryIsAnError) {
  const std::string error = error_of({"boundary[3]={on='left', displacement=['free',0]}"});
  EXPECT_THAT(error,
              HasSubstr("[contact] on = \"left\": contact on a clamped boundary; its displacement "
                        "along y is prescribed"));
  EXPECT_THAT(error, HasSubstr("[boundary[3]] displacement[1] = 0"));
}

TEST(Conflicts, WhereChargeCrossesTheContactNothingPrescribesIt) {
  const std::string electric =
      "contact.electric={law='exchange', coefficient=1e-9, foundation_potential=0}";
  EXPECT_EQ(error_of({electric}), "no error");
  EXPECT_THAT(error_of({electric, "boundary[3]={on='left', surface_charge=1}"}),
              HasSubstr("electric.law = \"exchange\" says what charge crosses there"));
  EXPECT_THAT(error_of({electric, "electrode=[{name='plate', on='left', voltage=1}]"}),
              HasSubstr("it is in a contact with electric.law = \"exchange\""));
}

TEST(Conflicts, WhatCrossesByTheContactsStateHasNodalMultipliers) {
  const std::string facets = "solver={method='monolithic', multiplier='piecewise-constant'}",
                    leak =
                        "contact.electric={law='leak', coefficient=1, foundation_potential=0, "
                        "ramp=1e-7}";
  for (const std::string &crossing : {std::string("contact.heat.friction_share=0.5"), leak}) {
    EXPECT_EQ(error_of({crossing, "solver.method=monolithic"}), "no error");
    EXPECT_EQ(error_of({crossing, "solver.body=iterative"}), "no error");
  }
  EXPECT_THAT(error_of({"contact.heat.friction_share=0.5", facets}),
              HasSubstr("contact with heat.friction_share is not available"));
  EXPECT_THAT(error_of({leak, facets}), HasSubstr("contact with electric.ramp is not available"));
}

TEST(Conflicts, WithoutFrictionThereIsNoHeatOfItToShare) {
  EXPECT_THAT(error_of({"contact.heat.friction_share=0.5", "contact.friction={law='none'}"}),
              HasSubstr("the contact has no friction"));
  EXPECT_EQ(error_of({"contact.heat.friction_share=0", "contact.friction={law='none'}"}),
            "no error");
}

TEST(Conflicts, TheTractionOnAContactBoundaryBelongsToTheLaw) {
  EXPECT_THAT(error_of({"boundary[3]={on='left', traction=[0,0]}"}),
              HasSubstr("the traction on a contact boundary"));
}

TEST(Conflicts, AnExchangingContactBoundaryHasNoFurtherThermalCondition) {
  EXPECT_THAT(error_of({"boundary[3]={on='left', temperature=0}"}), HasSubstr("heat.law"));
  EXPECT_THAT(error_of({"boundary[3]={on='left', heat_flux=0}"}), HasSubstr("heat.law"));
}

TEST(Conflicts, AnInsulatedContactBoundaryMayHaveATemperature) {
  EXPECT_EQ(error_of({"boundary[3]={on='left', temperature=0}", "contact.heat={law='insulated'}"}),
            "no error");
}

TEST(Conflicts, AContactBoundaryMayHaveAPotential) {
  EXPECT_EQ(error_of({"boundary[3]={on='left', potential=0}"}), "no error");
}

}  // namespace
}  // namespace tourmaline::casefile
