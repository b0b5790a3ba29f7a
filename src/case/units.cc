#include "case/units.h"

#include <fmt/format.h>
#include <udunits2.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <limits>
#include <memory>
#include <string_view>
#include <vector>

#include "case/nearest.h"
#include "case/toml_text.h"
#include "tourmaline/error.h"

namespace tourmaline::casefile {

namespace {

struct Free {
  void operator()(ut_system *system) const { ut_free_system(system); }
  void operator()(ut_unit *unit) const { ut_free(unit); }
  void operator()(cv_converter *converter) const { cv_free(converter); }
};
using Unit = std::unique_ptr<ut_unit, Free>;

// The library's own table of units, a file beside it.
const ut_system *all_units() {
  static const std::unique_ptr<ut_system, Free> system = [] {
    ut_set_error_message_handler(ut_ignore);
    return std::unique_ptr<ut_system, Free>(ut_read_xml(nullptr));
  }();
  if (!system)
    throw CaseError(
        "the table of units of UDUNITS cannot be read (package libudunits2-data); write numbers "
        "without units, in SI");
  return system.get();
}

// Whether there is a number that is neither an exponent nor the 1 of "1/K": "min 30" is no half an
// hour.
bool has_number_of_its_own(std::string_view unit) {
  if (unit.starts_with("1/"))
    unit.remove_prefix(1);
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  for (std::size_t i = 0; i < unit.size(); ++i) {
    if (!is_digit(unit[i]))
      continue;
    std::size_t before = i;
    while (before > 0 &&
           (unit[before - 1] == '-' || unit[before - 1] == '+' || unit[before - 1] == '^'))
      --before;
    if (before == 0 || !(std::isalnum(static_cast<unsigned char>(unit[before - 1])) != 0 ||
                         unit[before - 1] == ')'))
      return true;
  }
  return false;
}

// The library would also read moments ("s since 1970-01-01") and logarithms ("lg(re 1 mW)").
Unit unit_called(const std::string &name) {
  constexpr std::size_t longest = 80;
  if (name.size() > longest || name.find_first_of(std::string_view("@:\0", 3)) != std::string::npos)
    return nullptr;
  Unit unit(ut_parse(all_units(), name.c_str(), UT_UTF8));
  const bool is_moment = unit && name.find("since") != std::string::npos;
  return is_moment ? nullptr : std::move(unit);
}

// Not what the library calls convertible, to which "10 s" is 0.1/s.
bool are_of_one_kind(const ut_unit *one, const ut_unit *other) {
  const Unit quotient(ut_divide(one, other));
  return quotient && ut_is_dimensionless(quotient.get()) != 0 &&
         ut_are_convertible(one, other) != 0;
}

// Of those that people write, the ones of the same kind.
std::vector<std::string> units_like(const ut_unit *wanted) {
  std::vector<std::string> names;
  for (const char *prefix : {"", "G", "M", "k", "c", "m", "u", "n", "p"})
    for (const char *symbol : {"m", "s", "N", "Pa", "V", "C", "F", "ohm", "K", "W", "J", "N/m",
                               "N/m^2", "N/mm^2", "m/s", "C/m^2", "C/N", "W/m^2", "W/m^3"}) {
      const std::string name = std::string(prefix) + symbol;
      if (const Unit unit = unit_called(name); unit && are_of_one_kind(unit.get(), wanted))
        names.push_back(name);
    }
  return names;
}

// "pa" is a picoyear.
std::string meant_letters(const std::string &given, const std::vector<std::string> &units) {
  const auto lower = [](std::string text) {
    std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::tolower(c); });
    return text;
  };
  const auto found = std::ranges::find_if(
      units, [&](const std::string &unit) { return lower(unit) == lower(given); });
  return found == units.end() ? "" : "; did you mean \"" + *found + "\"?";
}

// The nearest number of 15 digits, where it is as near as round-off.
double without_round_off(double value) {
  const double decimal = std::stod(fmt::format("{:.15g}", value));
  const bool is_same =
      std::abs(decimal - value) <= 4 * std::numeric_limits<double>::epsilon() * std::abs(value);
  return is_same ? decimal : value;
}

bool begins_unit(std::string_view text) {
  const auto first = static_cast<unsigned char>(text.front());
  return std::isalpha(first) != 0 || first == '%' || first >= 0x80;
}

std::string_view trimmed_unit(std::string_view text) {
  const auto is_space = [](char c) { return c == ' ' || c == '\t'; };
  while (!text.empty() && is_space(text.front()))
    text.remove_prefix(1);
  while (!text.empty() && is_space(text.back()))
    text.remove_suffix(1);
  return text;
}

}  // namespace

std::optional<Quantity> quantity_in(const std::string &text) {
  std::string_view rest = trimmed_unit(text);
  if (rest.starts_with('+'))
    rest.remove_prefix(1);
  double number = 0;
  const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), number);
  if (error != std::errc() || !std::isfinite(number))  // "inf" is read as well
    return std::nullopt;
  const std::string_view behind = rest.substr(static_cast<std::size_t>(end - rest.data()));
  const std::string_view unit = trimmed_unit(behind);
  const bool is_spaced = unit.size() < behind.size();
  // "2e" and "2e*t" are numbers without their exponent.
  const bool lacks_exponent =
      !is_spaced && !behind.empty() && (behind.front() | ' ') == 'e' &&
      (behind.size() == 1 || std::isalpha(static_cast<unsigned char>(behind[1])) == 0);
  if (unit.empty() || lacks_exponent ||
      !(begins_unit(unit) || (is_spaced && unit.starts_with("1/"))))
    return std::nullopt;
  return Quantity{number, std::string(unit)};
}

Converted converted(const Quantity &quantity, const std::string &unit, bool is_absolute) {
  const std::string given = "\"" + shortened(quantity.unit) + "\"";
  const Unit from = unit_called(quantity.unit), to = unit_called(unit);
  if (unit.empty())
    return {.complaint = "has the unit " + given + ", but must be a number without unit"};
  if (!to)
    return {.complaint = "is in " + unit + ", which no unit is converted to; write the number"};
  if (from && has_number_of_its_own(quantity.unit))
    return {.complaint = given +
                         " is a unit with a number of its own; write one number, then the "
                         "unit: here it is " +
                         unit + ", or another of its kind"};
  if (!from)
    return {.complaint = given + " is no unit; here it is " + unit + ", or another of its kind" +
                         did_you_mean(quantity.unit, units_like(to.get()))};
  if (!are_of_one_kind(from.get(), to.get()))
    return {.complaint = given + " is a unit of another kind; here it is " + unit +
                         meant_letters(quantity.unit, units_like(to.get()))};
  const std::unique_ptr<cv_converter, Free> converter(ut_get_converter(from.get(), to.get()));
  if (!converter)
    return {.complaint = given + " cannot be converted to " + unit};
  if (cv_convert_double(converter.get(), 0) != 0 && !is_absolute)
    return {.complaint = given +
                         " has a zero of its own, and here stands a difference, to the "
                         "reference temperature where it is a temperature; write it in " +
                         unit};
  return {.value = without_round_off(cv_convert_double(converter.get(), quantity.number))};
}

}  // namespace tourmaline::casefile
