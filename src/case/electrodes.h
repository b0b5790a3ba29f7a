#pragma once

#include <string>

namespace tourmaline::casefile {

struct Case;

/// Throws CaseError where electrodes contradict themselves or each other: a name or a boundary
/// twice, conditions that exclude each other, a way `to` an electrode that is not there, voltages
/// to be found on a route that already looks for those of foundations.
void check_electrodes(const Case &asked);

/// Whether no electrode's voltage is to be found.
bool all_voltages_given(const Case &asked);

}  // namespace tourmaline::casefile
