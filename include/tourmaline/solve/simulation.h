#pragma once

#include <filesystem>

#include "tourmaline/case/case.h"

namespace tourmaline::solve {

/// Checks what needs the material library and this machine's memory, without building anything.
/// Throws CaseError.
void check(const casefile::Case &asked);

/// Runs a case and leaves its results in `directory`. Progress goes to a terminal on stderr unless
/// `quiet`. Throws CaseError, SolveError, MachineError; the results of the steps before the failure
/// are kept.
void simulate(const casefile::Case &asked, const std::filesystem::path &directory, bool quiet);

}  // namespace tourmaline::solve
