#pragma once

#include <array>
#include <cstdint>

namespace tourmaline::report {

using Colour = std::array<std::uint8_t, 3>;  ///< sRGB
using ColourMap = std::array<Colour, 256>;

/// From dark violet to yellow, lightness growing evenly (matplotlib's viridis at 17 places, CC0;
/// between them straight lines in OKLab).
const ColourMap &viridis();

/// For fields of both signs: blue, a neutral light grey at zero, red; lightness falls evenly to
/// both sides (straight lines in OKLab).
const ColourMap &blue_red();

/// The range of values that a map's ends stand for.
struct ColourRange {
  double low = 0, high = 1;
  bool diverging = false;  ///< blue_red, and zero amid the range
};

/// The range for values between `least` and `greatest`: diverging where both signs matter, which is
/// when the smaller one reaches a tenth of the greater.
ColourRange colour_range(double least, double greatest);

/// `range` as one of the map's 256 colours; beyond the ends the end's.
Colour colour_of(double value, const ColourRange &range);

}  // namespace tourmaline::report
