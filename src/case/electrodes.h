#pragma once

#include <string>

namespace tourmaline::casefile {

struct Case;

/// Throws CaseError where electrodes contradict themselves or each other: a name or a boundary
/// twice, conditions that exclude each other, a way `to` an electrode that is not there, an unknown
/// potential in the monolithic route.
void check_electrodes(const Case &asked);

/// Whether no electrode's voltage is to be found.
bool all_voltages_given(const Case &asked);

/// Throws CaseError, naming `solver`, where an electrode's voltage is not given: only the condensed
/// method with a direct solver finds it.
void require_given_voltages(const Case &asked, const std::string &solver);

}  // namespace tourmaline::casefile
