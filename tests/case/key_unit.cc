#include "case/key_unit.h"

#include <gtest/gtest.h>

#include "tourmaline/case/case.h"

namespace tourmaline::casefile {
namespace {

Case body_in_space() {
  Case body;
  body.mesh.box.emplace();
  body.mesh.box->cell = CellShape::hexahedron;
  return body;
}

Case body_of_revolution() {
  Case body;
  body.model.plane = "axisymmetric";
  return body;
}

std::string unit_of_key(const std::string &path) {
  return casefile::unit_of_key(path, Case());
}

TEST(UnitOfKey, ItIsTheDeclaredOne) {
  EXPECT_EQ(unit_of_key("contact.friction.bound"), "N/m^2");
  EXPECT_EQ(unit_of_key("time.end"), "s");
  EXPECT_EQ(unit_of_key("material.c11"), "Pa");
  EXPECT_EQ(unit_of_key("time.steps"), "");
  EXPECT_EQ(unit_of_key("time.stepps"), "");
}

TEST(UnitOfKey, ATableThatIsGivenAsAValueHasTheUnitOfThatKey) {
  EXPECT_EQ(unit_of_key("contact.friction.coefficient.distance"), "m");
  EXPECT_EQ(unit_of_key("contact.friction.coefficient"), "");
  EXPECT_EQ(unit_of_key("contact.normal"), "");
  EXPECT_EQ(unit_of_key("contact.normal.coefficient"), "N/m^(2+m) or N s/m^3");
}

TEST(UnitOfKey, EntriesOfListsHaveTheUnitOfTheList) {
  EXPECT_EQ(unit_of_key("boundary[2].potential"), "V");
  EXPECT_EQ(unit_of_key("boundary.2.traction[1]"), "N/m^2");
  EXPECT_EQ(unit_of_key("region[0].material.k33"), "W/(K m)");
}

TEST(UnitOfKey, InTwoDimensionsWhatIsOfTheWholeBodyIsPerMetreOfThickness) {
  EXPECT_EQ(unit_of_key("electrode[0].resistor"), "ohm m");
  EXPECT_EQ(unit_of_key("electrode[0].resistor", body_in_space()), "ohm");
  EXPECT_EQ(unit_of_key("electrode[0].capacitor"), "F/m");
  EXPECT_EQ(unit_of_key("electrode[0].charge", body_in_space()), "C");
}

TEST(UnitOfKey, OfABodyOfRevolutionItIsOfTheWholeBody) {
  EXPECT_EQ(unit_of_key("electrode[0].resistor", body_of_revolution()), "ohm");
  EXPECT_EQ(unit_of_key("contact.electric.circuit.charge", body_of_revolution()), "C");
}

TEST(UnitOfKey, TheCaseDecidesWhereItMay) {
  Case asked = body_in_space();
  asked.contacts.emplace_back().normal.law = "compliance";
  asked.contacts.front().normal.exponent = 2;
  EXPECT_EQ(unit_of_key("contact.normal.coefficient", asked), "N/m^4");
}

}  // namespace
}  // namespace tourmaline::casefile
