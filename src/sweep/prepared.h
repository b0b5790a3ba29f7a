#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tourmaline/case/case.h"
#include "tourmaline/sweep/member.h"
#include "tourmaline/sweep/sweep.h"

namespace tourmaline::sweep {

/// A member's case, read and checked.
struct Prepared {
  casefile::Case asked;
  std::string resolved;
};

/// Throws CaseError for the first member that cannot run.
std::vector<Prepared> prepared(const Request &request, const std::vector<Variation> &variations,
                               const std::vector<Member> &members);

/// Whether the folder holds the finished run of that case, and no file that the case names has
/// changed since.
bool is_done(const std::filesystem::path &folder, const Prepared &member);
/// Whether the folder holds a checkpoint of a run of this case.
bool was_interrupted(const std::filesystem::path &folder, const Prepared &member);

/// How many members may run side by side.
std::size_t jobs_for(const std::vector<Prepared> &members);

}  // namespace tourmaline::sweep
