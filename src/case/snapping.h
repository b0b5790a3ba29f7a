#pragma once

#include <string>
#include <vector>

namespace tourmaline::casefile {

struct Case;

/// A warning for each contact whose friction coefficient falls as it slips, somewhere on its
/// boundary in the first or the last step.
std::vector<std::string> snapping_warnings(const Case &asked);

}  // namespace tourmaline::casefile
