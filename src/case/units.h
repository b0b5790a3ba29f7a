#pragma once

#include <optional>
#include <string>

/// Numbers that are given with their unit, "5 kPa", by the UDUNITS library, which knows units,
/// their prefixes and products.
namespace tourmaline::casefile {

/// A text that is a number and a unit. Whether there is such a unit, `converted` says.
struct Quantity {
  double number;
  std::string unit;
};

/// Nothing where the text is something else: a number alone, a formula.
std::optional<Quantity> quantity_in(const std::string &text);

/// What is given, in another unit.
struct Converted {
  double value = 0;
  std::string complaint = {};  ///< why there is no value; empty: there is
};

/// The quantity in `unit`, rounded to the double that stands for its decimals: "0.3 mm" is 3e-4 m.
/// Scales with a zero of their own, as degC, are for absolute temperatures only.
Converted converted(const Quantity &quantity, const std::string &unit, bool is_absolute);

}  // namespace tourmaline::casefile
