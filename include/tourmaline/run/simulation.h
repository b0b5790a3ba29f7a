#pragma once

#include <filesystem>
#include <string>

#include "tourmaline/contact/friction.h"

namespace tourmaline::casefile {
struct Case;
}

namespace tourmaline::run {

/// Checks what needs the material library and this machine's memory, without building anything.
/// Throws CaseError.
void check(const casefile::Case &asked);
/// Builds mesh and operator as well, and evaluates all formulas at all places, in up to a hundred
/// steps. Throws CaseError.
void check_thoroughly(const casefile::Case &asked);

/// Where a run starts: from the beginning, or, where an earlier run of the case was interrupted in
/// the folder, from its checkpoint.
enum class Start { beginning, checkpoint };

/// How a case is run.
struct RunOptions {
  bool quiet = false;  ///< no progress on a terminal
  Start start = Start::beginning;
  /// Laws instead of the case's, asked for again in every step. What the case says of friction is
  /// still read and checked (`bound` stays mandatory), and counts for nothing else.
  contact::FrictionAt friction = {};
  /// What they are called, one line with all parameters that results depend on: "nap, 5 and 15
  /// N/m^2". Mandatory with `friction`. It stands in resolved.toml, summary.json and the page, and
  /// a run goes on from its checkpoint only under the same name.
  std::string friction_name = {};
};

/// Runs a case and leaves its results in `directory`. Progress goes to stderr. Throws CaseError,
/// SolveError, MachineError, Stopped, and nothing else; the results of the steps before are kept.
/// A program may call it again and again. MPI, which it starts unless it runs, runs until the
/// process ends, as it can be started only once; a program that ends MPI itself starts it itself.
void simulate(const casefile::Case &asked, const std::filesystem::path &directory,
              const RunOptions &options = {});

}  // namespace tourmaline::run
