#include "case/key_unit.h"

#include <gtest/gtest.h>

namespace tourmaline::casefile {
namespace {

TEST(UnitOfKey, ItIsTheDeclaredOne) {
  EXPECT_EQ(unit_of_key("contact.friction.bound", 2), "N/m^2");
  EXPECT_EQ(unit_of_key("time.end", 2), "s");
  EXPECT_EQ(unit_of_key("material.c11", 2), "Pa");
  EXPECT_EQ(unit_of_key("time.steps", 2), "");
  EXPECT_EQ(unit_of_key("time.stepps", 2), "");
}

TEST(UnitOfKey, ATableThatIsGivenAsAValueHasTheUnitOfThatKey) {
  EXPECT_EQ(unit_of_key("contact.friction.coefficient.distance", 2), "m");
  EXPECT_EQ(unit_of_key("contact.friction.coefficient", 2), "");
  EXPECT_EQ(unit_of_key("contact.normal", 2), "");
  EXPECT_EQ(unit_of_key("contact.normal.coefficient", 2), "N/m^(2+m) or N s/m^3");
}

TEST(UnitOfKey, EntriesOfListsHaveTheUnitOfTheList) {
  EXPECT_EQ(unit_of_key("boundary[2].potential", 2), "V");
  EXPECT_EQ(unit_of_key("boundary.2.traction[1]", 2), "N/m^2");
  EXPECT_EQ(unit_of_key("region[0].material.k33", 2), "W/(K m)");
}

TEST(UnitOfKey, InTwoDimensionsWhatIsOfTheWholeBodyIsPerMetreOfThickness) {
  EXPECT_EQ(unit_of_key("electrode[0].resistor", 2), "ohm m");
  EXPECT_EQ(unit_of_key("electrode[0].resistor", 3), "ohm");
  EXPECT_EQ(unit_of_key("electrode[0].capacitor", 2), "F/m");
  EXPECT_EQ(unit_of_key("electrode[0].charge", 3), "C");
}

}  // namespace
}  // namespace tourmaline::casefile
