#pragma once

#include "tourmaline/report/result.h"

namespace tourmaline::report {

/// Magnification of displacements, one digit times a power of ten, for which the greatest one is at
/// most a tenth of the body and strains stay below one, so that cells do not turn inside out; but
/// for the hundredth that is strained most, at singular corners. 1 when nothing moves. Of the last
/// state that `result` holds.
double suitable_scale(const Result &result);

/// The values below which one hundredth, and ninety-nine hundredths, of a field's component lie in
/// the last state.
struct Quantiles {
  double low = 0, high = 0;
};
Quantiles usual_range(const Result &result, const Field &field, std::size_t component);

/// Largest extent of the undeformed body along an axis [m].
double size_of(const Result &result);

}  // namespace tourmaline::report
