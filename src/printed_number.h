#pragma once

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <string>

namespace tourmaline {

/// An exponent: "⁻³". UTF-8.
inline std::string raised(int number) {
  static const std::array<const char *, 10> digits{"⁰", "¹", "²", "³", "⁴",
                                                   "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text;
  for (const char c : std::to_string(number))
    text += c == '-' ? "⁻" : digits[c - '0'];
  return text;
}

/// `digits` significant digits without needless zeros, powers of ten as they are printed: "0.0312",
/// "−3.96·10⁻¹¹". UTF-8.
inline std::string number_text(double value, int digits) {
  if (!std::isfinite(value))
    return "–";
  if (value == 0)
    return "0";
  const auto with_minus = [](const std::string &text) {
    return text.starts_with('-') ? "−" + text.substr(1) : text;
  };
  const std::string scientific = fmt::format("{:.{}e}", value, digits - 1);
  const int power = std::atoi(scientific.substr(scientific.find('e') + 1).c_str());
  if (power >= -3 && power < 5)
    return with_minus(fmt::format("{:g}", std::atof(scientific.c_str())));
  const double mantissa = std::atof(scientific.substr(0, scientific.find('e')).c_str());
  return with_minus(fmt::format("{:g}·10{}", mantissa, raised(power)));
}

}  // namespace tourmaline
