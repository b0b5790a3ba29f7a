#pragma once

#include <string>

#include "tourmaline/case/case.h"

namespace tourmaline::casefile {

/// The complete case as TOML, with all defaults filled in. Reading it gives the same case again,
/// every number to the last bit.
std::string resolved(const Case &asked);

}  // namespace tourmaline::casefile
