#include "report/colour_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace tourmaline::report {
namespace {

/// Relative luminance of sRGB (IEC 61966-2-1).
double luminance(const Colour &colour) {
  double sum = 0;
  const double weights[] = {0.2126, 0.7152, 0.0722};
  for (int i = 0; i < 3; ++i) {
    const double c = colour[i] / 255.;
    sum += weights[i] * (c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
  }
  return sum;
}

TEST(ColourMap, ViridisGrowsLighterAllTheWay) {
  for (std::size_t i = 8; i < 256; i += 8)
    EXPECT_GT(luminance(viridis()[i]), luminance(viridis()[i - 8])) << i;
}

TEST(ColourMap, BlueAndRedGrowDarkerAlikeToBothSidesOfZero) {
  for (std::size_t i = 0; i < 120; i += 8) {
    EXPECT_LT(luminance(blue_red()[i]), luminance(blue_red()[i + 8])) << i;
    EXPECT_LT(luminance(blue_red()[255 - i]), luminance(blue_red()[247 - i])) << i;
  }
  EXPECT_GT(blue_red().front()[2], blue_red().front()[0]);
  EXPECT_GT(blue_red().back()[0], blue_red().back()[2]);
}

TEST(ColourRange, ZeroIsAmidTheRangeWhereBothSignsMatter) {
  const ColourRange both = colour_range(-3, 2), mostly_positive = colour_range(-0.1, 2);
  EXPECT_TRUE(both.diverging);
  EXPECT_EQ(both.low, -both.high);
  EXPECT_EQ(both.high, 3);
  EXPECT_FALSE(mostly_positive.diverging);
  EXPECT_EQ(mostly_positive.low, -0.1);
}

TEST(ColourRange, AConstantFieldHasARangeToo) {
  EXPECT_LT(colour_range(0, 0).low, colour_range(0, 0).high);
  EXPECT_LT(colour_range(-5, -5).low, colour_range(-5, -5).high);
}

TEST(ColourRange, BeyondItsEndsTheEndsColourIsShown) {
  const ColourRange range = colour_range(1, 2);
  EXPECT_EQ(colour_of(9, range), viridis().back());
  EXPECT_EQ(colour_of(-9, range), viridis().front());
}

}  // namespace
}  // namespace tourmaline::report
