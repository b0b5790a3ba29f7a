#include "tourmaline/case/visitor.h"

#include <fmt/format.h>

#include <cmath>

namespace tourmaline::casefile {

bool Range::contains(double number) const {
  return std::isfinite(number) && (low_allowed ? number >= low : number > low) &&
         (high_allowed ? number <= high : number < high);
}

std::string Range::words() const {
  const std::string lower = fmt::format("{} {}", low_allowed ? ">=" : ">", low);
  const std::string upper = fmt::format("{} {}", high_allowed ? "<=" : "<", high);
  if (std::isfinite(low) && std::isfinite(high))
    return lower + " and " + upper;
  return std::isfinite(low) ? lower : std::isfinite(high) ? upper : "";
}

Range positive() {
  return {.low = 0, .low_allowed = false};
}
Range not_negative() {
  return {.low = 0};
}
Range at_least(double low) {
  return {.low = low};
}
Range from_to(double low, double high) {
  return {.low = low, .high = high};
}

Length one_each_axis(int dimension) {
  return {{dimension},
          "one for each axis",
          fmt::format("the shape of its cells makes the case {}-dimensional", dimension)};
}

}  // namespace tourmaline::casefile
