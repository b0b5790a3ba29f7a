#pragma once

#include <string>

namespace tourmaline::casefile {

struct Case;

/// The complete case as TOML, with all defaults filled in. Reading it gives the same case again,
/// every number to the last bit.
std::string resolved(const Case &asked);

}  // namespace tourmaline::casefile
