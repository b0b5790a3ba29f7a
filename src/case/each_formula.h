#pragma once

#include <functional>

#include "tourmaline/case/case.h"

namespace tourmaline::casefile {

/// Calls `look` with every formula that the case has, tables among them, in the order of the
/// schema.
void for_each_formula(const Case &asked, const std::function<void(const Formula &)> &look);

}  // namespace tourmaline::casefile
