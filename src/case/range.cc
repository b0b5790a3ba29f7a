#include "tourmaline/case/range.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tourmaline::casefile {

bool Range::contains(double number) const {
  return std::isfinite(number) && (low_allowed ? number >= low : number > low) &&
         (high_allowed ? number <= high : number < high);
}

bool Range::makes_sense(double number) const {
  return number == 0 || (std::abs(number) >= sense.least && std::abs(number) <= sense.most);
}

Range Range::narrowed() const {
  Range both = *this;
  if (low == 0 && !low_allowed && sense.least > 0) {
    both.low = sense.least;
    both.low_allowed = true;
  }
  if (-sense.most > low) {
    both.low = -sense.most;
    both.low_allowed = true;
  }
  if (sense.most < high) {
    both.high = sense.most;
    both.high_allowed = true;
  }
  return both;
}

std::string Range::words() const {
  const std::string lower = fmt::format("{} {}", low_allowed ? ">=" : ">", low);
  const std::string upper = fmt::format("{} {}", high_allowed ? "<=" : "<", high);
  if (std::isfinite(low) && std::isfinite(high))
    return lower + " and " + upper;
  return std::isfinite(low) ? lower : std::isfinite(high) ? upper : "";
}

std::string Range::sense_words(const std::string &unit) const {
  const std::string in_unit = unit.empty() ? "" : " " + unit;
  if (!std::isfinite(sense.most))
    return "";
  return sense.least > 0
             ? fmt::format("from {:g} to {:g}{} in size", sense.least, sense.most, in_unit)
             : fmt::format("at most {:g}{} in size", sense.most, in_unit);
}

Range positive(const Sense &sense) {
  return {.low = 0, .low_allowed = false, .sense = sense};
}
Range not_negative(const Sense &sense) {
  return {.low = 0, .sense = sense};
}
Range any(const Sense &sense) {
  return {.sense = sense};
}
Range at_least(double low) {
  return {.low = low};
}
Range from_to(double low, double high) {
  return {.low = low, .high = high};
}

std::string complaint(const Range &range, double number, const std::string &unit) {
  const std::string with_unit = unit.empty() ? "" : " " + unit;
  if (!std::isfinite(number))
    return "is not a finite number";
  if (!range.contains(number))
    return "must be " + range.words() + with_unit;
  if (!range.makes_sense(number))
    return "cannot be meant; it must be " + range.sense_words(unit);
  return "";
}

}  // namespace tourmaline::casefile
