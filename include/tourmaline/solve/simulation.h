#pragma once

#include <filesystem>

#include "tourmaline/case/case.h"

namespace tourmaline::solve {

/// Checks what needs the material library and this machine's memory, without building anything.
/// Throws CaseError.
void check(const casefile::Case &asked);

/// Where a run starts: from the beginning, or, where an earlier run of the case was interrupted in
/// the folder, from its checkpoint.
enum class Start { beginning, checkpoint };

/// Runs a case and leaves its results in `directory`. Progress goes to a terminal on stderr unless
/// `quiet`. Throws CaseError, SolveError, MachineError, Stopped; the results of the steps before
/// are kept.
void simulate(const casefile::Case &asked, const std::filesystem::path &directory, bool quiet,
              Start start = Start::beginning);

}  // namespace tourmaline::solve
