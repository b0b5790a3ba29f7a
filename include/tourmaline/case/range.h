#pragma once

#include <limits>
#include <string>

namespace tourmaline::casefile {

/// Sizes, without sign, that a number other than 0 can have and still be meant.
struct Sense {
  double least = 0;
  double most = std::numeric_limits<double>::infinity();
};

/// The values that a number may have: those that mathematics allows, and of these the ones that
/// somebody can mean.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_allowed = true, high_allowed = true;
  Sense sense = {};

  bool contains(double number) const;
  bool makes_sense(double number) const;
  /// The least and the greatest number of both kinds; `low_allowed` and `high_allowed` say of them
  /// what they say of `low` and `high` where the sense adds nothing.
  Range narrowed() const;
  /// "> 0", "from 1 to 2"; empty when every finite number is allowed.
  std::string words() const;
  /// "from 1e-12 to 1e+09 m in size"; empty when every size makes sense.
  std::string sense_words(const std::string &unit) const;
};

Range positive(const Sense &sense = {});
Range not_negative(const Sense &sense = {});
Range any(const Sense &sense);
Range at_least(double low);
Range from_to(double low, double high);

/// What is wrong with a number that is given or computed, in that unit; empty: nothing.
std::string complaint(const Range &range, double number, const std::string &unit);

}  // namespace tourmaline::casefile
