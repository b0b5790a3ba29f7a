#include "case/key_unit.h"

#include <gtest/gtest.h>

namespace tourmaline::casefile {
namespace {

TEST(UnitOfKey, ItIsTheDeclaredOne) {
  EXPECT_EQ(unit_of_key("contact.friction.bound"), "N/m^2");
  EXPECT_EQ(unit_of_key("time.end"), "s");
  EXPECT_EQ(unit_of_key("material.c11"), "Pa");
  EXPECT_EQ(unit_of_key("time.steps"), "");
  EXPECT_EQ(unit_of_key("time.stepps"), "");
}

TEST(UnitOfKey, EntriesOfListsHaveTheUnitOfTheList) {
  EXPECT_EQ(unit_of_key("boundary[2].potential"), "V");
  EXPECT_EQ(unit_of_key("boundary.2.traction[1]"), "N/m^2");
  EXPECT_EQ(unit_of_key("region[0].material.k33"), "W/(K m)");
}

}  // namespace
}  // namespace tourmaline::casefile
