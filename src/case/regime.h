#pragma once

#include <string>

namespace tourmaline::casefile {

struct Case;

/// Throws CaseError for what the case's regime of time has no place for: what has a rate is not
/// available in a static one, and heat that nothing lets out has no steady state.
void check_regime(const Case &asked);

/// Whether a static case has nothing that holds its temperature: then it stays as it was.
bool keeps_temperature(const Case &asked);

}  // namespace tourmaline::casefile
