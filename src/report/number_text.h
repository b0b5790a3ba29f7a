#pragma once

#include <string>

namespace tourmaline::report {

/// `digits` significant digits without needless zeros, powers of ten as they are printed: "0.0312",
/// "−3.96·10⁻¹¹". UTF-8.
std::string number_text(double value, int digits);

/// A power of ten, 0 or another multiple of three, by which values of this size are shown.
int shown_power(double size);

/// The unit behind values that were divided by 10^power: "10⁻³ K".
std::string unit_text(int power, const std::string &unit);

}  // namespace tourmaline::report
