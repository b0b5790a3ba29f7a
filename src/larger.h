#pragma once

#include <cmath>

namespace tourmaline {

/// The larger of two numbers; NaN where one of them is. `std::max(a, NaN)` is a, by which a
/// residual that is not a number would look like a small one.
inline double larger(double a, double b) {
  return std::isnan(a) || a > b ? a : b;
}

/// residual / size for a verdict: 0 where nothing is left, NaN where a size overflowed, by which
/// everything else would look small.
inline double relative_to(double residual, double size) {
  if (residual == 0 && std::isfinite(size))
    return 0;
  return std::isinf(size) ? std::nan("") : residual / size;
}

}  // namespace tourmaline
