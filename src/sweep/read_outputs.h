#pragma once

#include <filesystem>
#include <vector>

#include "sweep/outputs.h"

namespace tourmaline::sweep {

/// The values of outputs in a run's folder; NaN where it lacks one. Throws CaseError when the
/// folder's files cannot be read.
std::vector<double> read_outputs(const std::filesystem::path &folder,
                                 const std::vector<Output> &outputs);

}  // namespace tourmaline::sweep
