#pragma once

#include "tourmaline/case/case.h"

namespace tourmaline::casefile {

/// Throws CaseError where electrodes contradict themselves or each other: a name or a boundary
/// twice, conditions that exclude each other, a way `to` an electrode that is not there, an unknown
/// potential in the monolithic route.
void check_electrodes(const Case &asked);

}  // namespace tourmaline::casefile
