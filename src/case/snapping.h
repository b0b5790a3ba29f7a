#pragma once

#include <string>
#include <vector>

namespace tourmaline::casefile {

struct Case;

/// A warning for each contact whose friction coefficient falls as it slips, somewhere on its
/// boundary in the first or the last step, or only grows: its values may have been interchanged.
std::vector<std::string> snapping_warnings(const Case &asked);

}  // namespace tourmaline::casefile
