#include "case/units.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "case/resolved.h"
#include "case/schema.h"
#include "error_in.h"
#include "example.h"
#include "mistake.h"
#include "tourmaline/case/case.h"
#include "tourmaline/case/reader.h"

namespace tourmaline::casefile {
namespace {

using testing::HasSubstr;

Case with(const std::vector<std::string> &overrides, const std::string &text = example) {
  return read_text(text, "case.toml", overrides);
}

struct Conversion {
  std::string text, unit;
  double value;  ///< to the last digit
  bool is_absolute = false;
};

void PrintTo(const Conversion &conversion, std::ostream *out) {
  *out << conversion.text << " in " << conversion.unit;
}

class UnitConversion : public testing::TestWithParam<Conversion> {};

TEST_P(UnitConversion, GivesTheNumberThatTheDecimalsStandFor) {
  const Conversion &expected = GetParam();
  const auto quantity = quantity_in(expected.text);
  ASSERT_TRUE(quantity);
  const Converted found = converted(*quantity, expected.unit, expected.is_absolute);
  EXPECT_EQ(found.complaint, "");
  EXPECT_EQ(found.value, expected.value);
}

const Conversion conversions[] = {
    {"5 kPa", "N/m^2", 5000},
    {"0.3 mm", "m", 3e-4},
    {"0.7um", "m", 7e-7},
    {"-3.3 µm", "m", -3.3e-6},
    {" +2e3 mm ", "m", 2},
    {".5 m", "m", 0.5},
    {"1 in", "m", 0.0254},
    {"27 degC", "K", 300.15, true},
    {"27 K", "K", 27},
    {"12 N/mm^2", "Pa", 12e6},
    {"12 N/mm²", "Pa", 12e6},
    {"22 pC/N", "C/N", 22e-12},
    {"3 W/(cm2 degC)", "W/(K m^2)", 3e4},
    {"2 MΩ", "ohm", 2e6},
    {"2 kohm cm", "ohm m", 20},
    {"5 1/ms", "1/s", 5000},
    {"2 min", "s", 120},
    {"0.5 mm", "0.001 m", 0.5},
    {"7.8 g/cm3", "kg/m^3", 7800},
    {"1.23456789012345 kPa", "Pa", 1234.56789012345},
};
INSTANTIATE_TEST_SUITE_P(Units, UnitConversion, testing::ValuesIn(conversions));

TEST(Quantity, NumbersAndFormulasAreNone) {
  for (const char *text : {"5", "5*t", "2*x", "1e3", "2e", "2e*t", "-1e-3*sin(t)", "x", "mm",
                           "inf m", "nan s", "5 (x)", "1e999 m", "", "t > 0 ? 5 : 6", "5 > t"})
    EXPECT_FALSE(quantity_in(text)) << text;
}

TEST(Quantity, MoreDigitsThanANumberHasAreRoundOff) {
  const auto quantity = quantity_in("1.23456789012345678 kPa");
  ASSERT_TRUE(quantity);
  EXPECT_DOUBLE_EQ(converted(*quantity, "Pa", false).value, 1234.56789012345678);
}

TEST(Quantity, WhatIsNoLengthIsRefused) {
  for (const char *text :
       {"5 s", "5 1/m", "5 kPa", "5 apples", "5 MM", "5 m*x", "5 m @ 3", "5 s since 1970-01-01",
        "5 lg(re 1 m)", "5 m^99999999999", "5 %", "5 m/0", "5 m((((((((", "5 rad", "5 t"})
    EXPECT_NE(converted(quantity_in(text).value(), "m", false).complaint, "") << text;
  EXPECT_NE(converted({5, std::string("m\0x", 3)}, "m", false).complaint, "");
}

// UDUNITS reads "min 30" as half an hour.
TEST(Quantity, LettersOfTheWrongSizeAreMetWithTheUnitThatIsMeant) {
  EXPECT_THAT(error_in(example, {"contact.friction.bound=5 pa"}),
              HasSubstr("is a unit of another kind; here it is N/m^2; did you mean \"Pa\"?"));
}

TEST(Quantity, DecimalsWithACommaAreSaidToBeThat) {
  for (const char *text : {"1,5 kPa", "1,5", "-2,0 N/m^2"})
    EXPECT_THAT(error_in(example, {std::string("contact.friction.bound=") + text}),
                HasSubstr("decimals take a point"))
        << text;
}

TEST(Quantity, HasOneNumber) {
  for (const char *text : {"2 min 30", "2 min.5", "2 min/2"})
    EXPECT_THAT(converted(quantity_in(text).value(), "s", false).complaint,
                HasSubstr("a number of its own"))
        << text;
  for (const char *text : {"2 s1", "2 s^1", "2 1/s-1", "2 s2 Hz"})
    EXPECT_EQ(converted(quantity_in(text).value(), "s", false).value, 2) << text;
}

TEST(Quantity, DegreesAreNoDifference) {
  EXPECT_THAT(converted({27, "degC"}, "K", false).complaint, HasSubstr("write it in K"));
  EXPECT_EQ(converted({27, "1/degC"}, "1/K", false).value, 27);
}

// Declares every key and looks at its unit.
class UnitsOfKeys : public Visitor {
 public:
  std::vector<std::string> units;

  void key(const Key &key, Value) override {
    if (const std::string &unit = key.actual_unit(); !unit.empty())
      units.push_back(unit);
  }
  bool given(const Key &, bool) override { return true; }
  void table(const Key &, const Body &body) override { body(*this); }
  int count(const Key &, int) override { return 1; }
  void entry(const Key &, int, const Body &body) override { body(*this); }
};

TEST(Quantity, UnitsOfKeysAreUnitsWhereTheCaseLeavesNoChoice) {
  UnitsOfKeys all;
  Case any;
  declare(all, any);
  EXPECT_GT(all.units.size(), 100);
  for (const std::string &unit : all.units) {
    if (unit.find(" or ") != std::string::npos)
      continue;
    EXPECT_EQ(converted({1, unit}, unit, true).value, 1) << unit;
  }
}

TEST(NumbersWithUnits, StandInNumbersFormulasListsAndPoints) {
  const Case asked = with({"time.end=200 ms", "mesh.box.max=['10 cm', 0.1]",
                           "boundary[2].traction=['-5 kPa', '-0.5*t']",
                           "boundary[0].displacement=['free', '2 um']",
                           "boundary[1].temperature={ points = [['0 s', 0], ['0.2 s', '3 K']] }",
                           "contact.friction.bound=15 mPa"});
  EXPECT_EQ(asked.time.end, 0.2);
  EXPECT_EQ(asked.mesh.box->max[0], 0.1);
  EXPECT_EQ(resolved(asked).find('\''), std::string::npos);
  for (const char *piece : {"traction = [-5000, \"-0.5*t\"]", "displacement = [\"free\", 2e-06]",
                            "points = [[0, 0], [0.2, 3]]", "bound = 0.015"})
    EXPECT_THAT(resolved(asked), HasSubstr(piece));
}

TEST(NumbersWithUnits, StandInMaterials) {
  const Case asked = with({"material.reference_temperature=27 degC", "material.density=6.02 g/cm3",
                           "material.pyroelectric=[0, '10 nC/(cm^2 K)']"});
  EXPECT_EQ(asked.material.constants.at("reference_temperature"), 300.15);
  EXPECT_EQ(asked.material.constants.at("density"), 6020);
  EXPECT_EQ(asked.material.pyroelectric.value()[1], 1e-4);
}

TEST(NumbersWithUnits, OfCircuitsFollowThePlane) {
  const std::string electrode = "electrode=[{ name = 'e', on = 'bottom', resistor = '2 kohm'}]",
                    per_metre = "electrode=[{ name = 'e', on = 'bottom', resistor = '2 kohm m'}]";
  EXPECT_EQ(with({per_metre}).electrodes[0].resistor, 2000);
  EXPECT_THAT(error_in(example, {electrode}), HasSubstr("here it is ohm m"));
  EXPECT_EQ(with({electrode, "model.plane=axisymmetric", "boundary[0].displacement=['free', 0]"})
                .electrodes[0]
                .resistor,
            2000);
}

TEST(NumbersWithUnits, OfComplianceFollowItsExponent) {
  const std::string law =
      "contact.normal={ law = 'compliance', coefficient = '2 MPa/mm', exponent = ";
  EXPECT_EQ(with({law + "1 }"}).contacts[0].normal.coefficient.value({}, 0), 2e9);
  EXPECT_THAT(error_in(example, {law + "2 }"}), HasSubstr("here it is N/m^4"));
  EXPECT_THAT(error_in(example, {law + "1.5 }"}), HasSubstr("N/m^(2+m), which no unit"));
}

const Mistake units[] = {
    {"end = 0.2",
     "end = \"200 mm\"",
     {"case.toml:11:", "end = \"200 mm\"", "another kind", "here it is s"}},
    {"end = 0.2", "end = \"-200 ms\"", {"end = \"-200 ms\"", "must be > 0 s"}},
    {"end = 0.2", "end = \"200\"", {"is a text, but must be a number [s]"}},
    {"bound = 15", "bound = \"15 kpa\"", {"\"kpa\" is no unit", "did you mean \"kPa\"?"}},
    {"temperature = 0",
     "temperature = \"27 degC\"",
     {"a difference, to the reference temperature"}},
    {"temperature = 0", "temperature = \"2 t\"", {"in a formula * stands before t"}},
    {"pyroelectric = [0, 1e-4]", "poisson = \"30 %\"", {"must be a number without unit"}},
};
INSTANTIATE_TEST_SUITE_P(Units, MistakeInAFile, testing::ValuesIn(units));

}  // namespace
}  // namespace tourmaline::casefile
