#pragma once

#include <filesystem>

#include "tourmaline/contact/friction.h"

namespace tourmaline::casefile {
struct Case;
}

namespace tourmaline::run {

/// Checks what needs the material library and this machine's memory, without building anything.
/// Throws CaseError.
void check(const casefile::Case &asked);

/// Where a run starts: from the beginning, or, where an earlier run of the case was interrupted in
/// the folder, from its checkpoint.
enum class Start { beginning, checkpoint };

/// How a case is run.
struct RunOptions {
  bool quiet = false;  ///< no progress on a terminal
  Start start = Start::beginning;
  contact::FrictionAt friction = {};  ///< instead of the case's law; asked for again in every step
};

/// Runs a case and leaves its results in `directory`. Progress goes to stderr. Throws CaseError,
/// SolveError, MachineError, Stopped; the results of the steps before are kept.
void simulate(const casefile::Case &asked, const std::filesystem::path &directory,
              const RunOptions &options = {});

}  // namespace tourmaline::run
