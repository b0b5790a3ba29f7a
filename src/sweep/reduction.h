#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace tourmaline::sweep {

/// How a column of history.csv, a value at the end of each step, becomes one number.
struct Reduction {
  enum class Kind { last, min, max, mean, rms, at };

  /// A part of the run's time [s].
  struct Window {
    double from, to;
    bool operator==(const Window &) const = default;
  };

  Kind kind = Kind::last;
  double time = 0;                    ///< of `at` [s]
  std::optional<Window> window = {};  ///< of `min` to `rms`; all of the time where there is none

  bool operator==(const Reduction &) const = default;
};

/// The words before a colon, "last" to "rms", in their order.
const std::vector<std::string> &reduction_words();

/// What a word before a colon asks for; nothing when it is none of them.
std::optional<Reduction> reduction_named(const std::string &word);

/// Means weigh each step with its length, from 0 on, or with what of it lies in the window;
/// extremes are those of steps of which some does. At a time between the ends of two steps the
/// value lies on the straight line between theirs. NaN when there are no values, no step
/// lies in the window, or the time is before the end of the first step or behind that of the last.
double reduced(const Reduction &reduction, std::span<const double> times,
               std::span<const double> values);

}  // namespace tourmaline::sweep
