#pragma once

#include <string>

#include "printed_number.h"

namespace tourmaline::report {

/// A power of ten, 0 or another multiple of three, by which values of this size are shown.
int shown_power(double size);

/// The unit behind values that were divided by 10^power: "10⁻³ K".
std::string unit_text(int power, const std::string &unit);

}  // namespace tourmaline::report
