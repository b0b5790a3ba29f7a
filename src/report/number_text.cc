#include "report/number_text.h"

#include <cmath>

namespace tourmaline::report {

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
