#pragma once

#include <string>

namespace tourmaline::casefile {

struct Case;

/// The unit of the key with that dotted path, `boundary[1].potential`, in that case; empty when it
/// has none, or there is no such key.
std::string unit_of_key(const std::string &path, const Case &asked);

}  // namespace tourmaline::casefile
