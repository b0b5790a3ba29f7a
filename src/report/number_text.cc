#include "report/number_text.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdlib>

namespace tourmaline::report {
namespace {

std::string raised(int number) {
  static const std::array<const char *, 10> digits{"⁰", "¹", "²", "³", "⁴",
                                                   "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text;
  for (const char c : std::to_string(number))
    text += c == '-' ? "⁻" : digits[c - '0'];
  return text;
}

std::string with_minus(const std::string &text) {
  return text.starts_with('-') ? "−" + text.substr(1) : text;
}

}  // namespace

std::string number_text(double value, int digits) {
  if (!std::isfinite(value))
    return "–";
  if (value == 0)
    return "0";
  const std::string scientific = fmt::format("{:.{}e}", value, digits - 1);
  const int power = std::atoi(scientific.substr(scientific.find('e') + 1).c_str());
  if (power >= -3 && power < 5)
    return with_minus(fmt::format("{:g}", std::atof(scientific.c_str())));
  const double mantissa = std::atof(scientific.substr(0, scientific.find('e')).c_str());
  return with_minus(fmt::format("{:g}·10{}", mantissa, raised(power)));
}

int shown_power(double size) {
  if (!(size > 0) || !std::isfinite(size) || (size >= 0.01 && size < 1000))
    return 0;
  return 3 * static_cast<int>(std::floor(std::log10(size) / 3));
}

std::string unit_text(int power, const std::string &unit) {
  if (power == 0)
    return unit;
  return "10" + raised(power) + (unit.empty() ? "" : " " + unit);
}

}  // namespace tourmaline::report
