#pragma once

#include <filesystem>

#include "report/result.h"

namespace tourmaline::report {

/// Adds the boundaries that a run has recorded, as far as they are seen, and how its contact lies
/// along them: in pieces in the plane, in faces in space. Throws CaseError when a file is damaged.
void read_boundaries(Result &result, const std::filesystem::path &folder);

/// Says so where the contact has rows that no boundary tells the order of.
void remark_on_contact(Result &result);

}  // namespace tourmaline::report
