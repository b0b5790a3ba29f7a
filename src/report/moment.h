#pragma once

#include <fmt/format.h>

#include "tourmaline/error.h"

namespace tourmaline::report {

/// Throws CaseError for a time that somebody asks for and that is not between 0 and the last one
/// [s]. Round-off counts as nothing.
inline void require_moment(double asked, double last) {
  constexpr double rounding = 1e-9;
  if (!(asked >= -rounding * last && asked <= (1 + rounding) * last))
    throw CaseError(
        fmt::format("--time {}: is not in the results, which go from t = 0 to {} s", asked, last));
}

}  // namespace tourmaline::report
