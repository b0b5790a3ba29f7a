#pragma once

#include <string>
#include <vector>

#include "sweep/outputs.h"

namespace tourmaline::sweep {

/// The outputs of the given names, which one of the cases has at least; when there are no names,
/// what one looks at first. NAME or last:NAME is a column in its last row; min:, max:, mean: and
/// rms:NAME take all of it, or with @FROM..TO behind them a part of the time, NAME@T its value at
/// the time T [s]. Throws CaseError.
std::vector<Output> chosen_outputs(const std::vector<std::string> &names,
                                   const std::vector<casefile::Case> &cases);

}  // namespace tourmaline::sweep
