#include "report/packing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace tourmaline::report {
namespace {

// That the numbers come back is checked where they are read: web/tests/report.mjs compares what the
// page says with nodes.csv. Here: that they are small, and what the description promises.

std::vector<float> ramp(std::size_t rows, std::size_t columns) {
  std::vector<float> values;
  for (std::size_t r = 0; r < rows; ++r)
    for (std::size_t c = 0; c < columns; ++c)
      values.push_back(static_cast<float>(static_cast<double>(r) * std::sin(1.7 * double(c))));
  return values;
}

TEST(Packing, WhatGrowsEvenlyInTimeTakesAFractionOfItsBytes) {
  Packing packing;
  const std::vector<float> values = ramp(50, 1000);
  const auto levels = packing.levels(values, 50);
  // Two bytes a value before; rounding to levels leaves differences of -1, 0, 1.
  EXPECT_LT(levels["length"].get<std::size_t>(), values.size() * 2 / 4);
}

TEST(Packing, TheDescriptionSaysWhereEachArrayIsAndHowItIsShaped) {
  Packing packing;
  const auto first = packing.floats(ramp(2, 30), 2);
  const auto second = packing.integers(std::vector<std::uint32_t>{3, 1, 4000000000U});
  EXPECT_EQ(first["rows"], 2);
  EXPECT_EQ(first["columns"], 30);
  EXPECT_EQ(second["columns"], 3);
  EXPECT_EQ(second["at"], first["length"]);
  EXPECT_EQ(packing.text().size(),
            second["at"].get<std::size_t>() + second["length"].get<std::size_t>());
}

TEST(Packing, LevelsReachFromTheLeastToTheGreatestValue) {
  Packing packing;
  const auto levels = packing.levels(std::vector<float>{-2, 0, 5}, 1);
  EXPECT_EQ(levels["low"], -2);
  EXPECT_DOUBLE_EQ(levels["low"].get<double>() + 65535 * levels["step"].get<double>(), 5);
}

TEST(Packing, ConstantAndEmptyFieldsArePacked) {
  Packing packing;
  EXPECT_EQ(packing.levels(std::vector<float>{3, 3, 3}, 1)["step"], 0);
  EXPECT_EQ(packing.floats({}, 0)["columns"], 0);
}

}  // namespace
}  // namespace tourmaline::report
