#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "tourmaline/case/case.h"
#include "tourmaline/output/checkpoint.h"

namespace tourmaline::solve {

/// What a run was asked for, to be compared when it is to go on: the resolved case, and under
/// [contents] a digest of every file that it reads.
std::string inputs_of(const casefile::Case &asked);

/// What an earlier run of this case left in a folder to go on with.
struct Resumption {
  bool is_complete = false;                      ///< nothing is left to do
  std::optional<output::Checkpoint> checkpoint;  ///< none: it starts from the beginning
};

/// Throws CaseError when the run there was another case, with the keys that differ, or had another
/// number of ranks; MachineError when its checkpoint cannot be used.
Resumption resumption(const casefile::Case &asked, const std::filesystem::path &directory);

}  // namespace tourmaline::solve
