#pragma once

#include <string>

namespace tourmaline::casefile {

/// How far apart two checkpoints are: so many steps or so many seconds, whichever is not 0; both 0:
/// there are none.
struct Interval {
  int steps = 0;
  double seconds = 0;
};

/// Reads "10 steps", "30 s", "5 min", "2 h" or "never". Throws CaseError with what is allowed.
Interval interval(const std::string &text);

/// What is wrong with the text, or nothing.
std::string interval_complaint(const std::string &text);

}  // namespace tourmaline::casefile
