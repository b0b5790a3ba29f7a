#pragma once

#include <string>

namespace tourmaline::casefile {

struct Case;

/// A warning of a friction coefficient that falls as the contact slips, somewhere on the contact
/// boundary in the first or the last step; empty: it does not.
std::string snapping_warning(const Case &asked);

}  // namespace tourmaline::casefile
