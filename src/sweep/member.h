#pragma once

#include <string>
#include <vector>

#include "sweep/variation.h"

namespace tourmaline::sweep {

/// One case of a study.
struct Member {
  std::string name;                 ///< of its folder: "bound=5_coefficient=0.1"
  std::vector<std::string> values;  ///< one for each variation
};

/// Every value of each variation with every one of the others; the last variation turns fastest.
/// Throws CaseError when that is too many.
std::vector<Member> members_of(const std::vector<Variation> &variations);

/// What `--set` says for a member.
std::vector<std::string> overrides_of(const std::vector<Variation> &variations,
                                      const Member &member);

}  // namespace tourmaline::sweep
