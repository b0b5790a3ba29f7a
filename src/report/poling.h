#pragma once

#include <vector>

#include "report/result.h"

namespace tourmaline::report {

/// The direction of poling at one place, from `tail` to `tip` [m] in the undeformed body.
struct PolingArrow {
  Vector3 tail, tip;
};

/// Some tens of arrows for the picture of the setting, spread evenly over what `view_of` shows of
/// the poled parts, about six at least for each, two where there are many. A part is what hangs
/// together of a region without a jump of the poling by a right angle or more. The same result
/// gives the same arrows. None where the field files do not tell the poling.
std::vector<PolingArrow> poling_arrows(const Result &result);

}  // namespace tourmaline::report
