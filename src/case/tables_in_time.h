#pragma once

#include <string>
#include <vector>

namespace tourmaline::casefile {

struct Case;

/// Throws CaseError for a table that does not say what its value is at all times of the run.
void check_tables(const Case &asked);

/// A warning of each table that goes on for a hundred times the run, as one in ms may.
std::vector<std::string> table_warnings(const Case &asked);

/// The times, in ascending order and inside the run, at which a table of the case bends [s].
std::vector<double> bends(const Case &asked);

}  // namespace tourmaline::casefile
