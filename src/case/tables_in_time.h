#pragma once

namespace tourmaline::casefile {

struct Case;

/// Throws CaseError for a table that does not say what its value is at all times of the run.
void check_tables(const Case &asked);

}  // namespace tourmaline::casefile
