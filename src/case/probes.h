#pragma once

namespace tourmaline::casefile {

struct Case;

/// Throws CaseError where a probe's name cannot be that of a file, or is another one's.
void check_probes(const Case &asked);

}  // namespace tourmaline::casefile
