#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "output/checkpoint.h"
#include "tourmaline/case/case.h"

namespace tourmaline::run {

/// A digest of what stands in every file that the case reads, by its name: of a mesh what was read,
/// so that files which a geometry includes count; of materials the bytes.
std::map<std::string, std::string> contents_of(const casefile::Case &asked);

/// What a run was asked for, to be compared when it is to go on: the resolved case, under [program]
/// the name of the friction laws that a program brings along instead of the case's, if it does, and
/// under [contents] those digests.
std::string inputs_of(const casefile::Case &asked, const std::string &friction_name = "");

/// How two of these differ, in words; "" where a run of the one can go on as the other.
std::string differences(const std::string &then, const std::string &now);

/// What an earlier run of this case left in a folder to go on with.
struct Resumption {
  bool has_all_steps = false;                    ///< at most the page is missing
  bool has_report = false;                       ///< or is not asked for; all steps before it
  std::optional<output::Checkpoint> checkpoint;  ///< none: it starts from the beginning
  std::string warning;  ///< where field files of a complete run are no longer there or whole

  bool is_complete() const { return has_all_steps && has_report; }
};

/// Call it with the folder's lock, or what it says may be over. Throws CaseError when the run there
/// was another case or had other friction laws, with the keys and files that differ, or had another
/// number of ranks; MachineError when its checkpoint cannot be used, or files on which that counts
/// are missing.
Resumption resumption(const casefile::Case &asked, const std::filesystem::path &directory,
                      const std::string &friction_name = "");

}  // namespace tourmaline::run
