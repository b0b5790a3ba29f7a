#pragma once

#include "report/result.h"

namespace tourmaline::report {

/// Magnification of displacements, one digit times a power of ten, for which the greatest one is at
/// most a tenth of the body and no cell is folded: every triangle of the skin keeps a tenth of its
/// area, every cell of a solid one a tenth of its thickness in any direction. 1 when nothing moves.
/// Of all states that `result` holds.
double suitable_scale(const Result &result);

/// The values below and above which `share` of a field's component lies in the last state.
struct Quantiles {
  double low = 0, high = 0;
};
Quantiles usual_range(const Result &result, const Field &field, std::size_t component,
                      double share);

/// What the colours of a field's component stand for in the last state: its least to its greatest
/// value; of what is derived, without the lowest or the highest three hundredths where these reach
/// half as far again, as at singular corners and in layers beside the contact, which would leave
/// nothing to be seen of the rest.
struct ShownRange {
  double low = 0, high = 0;
  bool cut_below = false, cut_above = false;
  std::string instead;  ///< said where there is no range: constant, or below round-off
};
ShownRange shown_range(const Result &result, const Field &field, std::size_t component);

/// Largest extent of the undeformed body along an axis [m].
double size_of(const Result &result);

}  // namespace tourmaline::report
