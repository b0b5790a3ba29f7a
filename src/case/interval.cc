#include "case/interval.h"

#include <charconv>
#include <cmath>
#include <limits>
#include <optional>

#include "tourmaline/error.h"

namespace tourmaline::casefile {

namespace {

constexpr double longest = 1e12;  // [s]; clocks count no further

std::optional<Interval> in_unit(double number, const std::string &unit) {
  const bool whole = number == std::floor(number) && number <= std::numeric_limits<int>::max();
  if ((unit == "steps" && whole) || (unit == "step" && number == 1))
    return Interval{.steps = static_cast<int>(number)};
  constexpr struct {
    const char *name;
    double seconds;
  } units[] = {{"s", 1}, {"min", 60}, {"h", 3600}};
  for (const auto &known : units)
    if (unit == known.name && number * known.seconds < longest)
      return Interval{.seconds = number * known.seconds};
  return std::nullopt;
}

std::optional<Interval> parsed(const std::string &text) {
  if (text == "never")
    return Interval{};
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || !std::isfinite(number) || number <= 0)
    return std::nullopt;
  const std::string rest(end, text.data() + text.size());
  const std::size_t unit = rest.find_first_not_of(' ');
  return unit == std::string::npos ? std::nullopt : in_unit(number, rest.substr(unit));
}

}  // namespace

Interval interval(const std::string &text) {
  if (const std::optional<Interval> found = parsed(text))
    return *found;
  throw CaseError("\"" + text + "\" is no interval: " + interval_complaint(text));
}

std::string interval_complaint(const std::string &text) {
  return parsed(text) ? ""
                      : "must be a number of steps, \"10 steps\", a time, \"30 s\", \"5 min\" or "
                        "\"2 h\", or \"never\"";
}

}  // namespace tourmaline::casefile
