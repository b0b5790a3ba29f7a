#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sweep/member.h"
#include "sweep/sweep.h"
#include "tourmaline/case/case.h"

namespace tourmaline::sweep {

/// A member's case, read and checked.
struct Prepared {
  casefile::Case asked;
};

/// Throws CaseError for the first member that cannot run.
std::vector<Prepared> prepared(const Request &request, const std::vector<Variation> &variations,
                               const std::vector<Member> &members);

/// What a member's folder holds of an earlier run.
struct Found {
  enum class State { nothing, interrupted, done } state = State::nothing;
  std::string obstacle;  ///< why an interrupted run cannot go on; it starts from the beginning then
};

/// Done is a run of that case, with the same content of the files that it names, whose page is
/// there where one is asked for. Nothing is thrown for what stands in the folder.
Found found_in(const std::filesystem::path &folder, const Prepared &member);

/// How many members may run side by side.
std::size_t jobs_for(const std::vector<Prepared> &members);

}  // namespace tourmaline::sweep
