#pragma once

#include <string>

namespace tourmaline::casefile {

struct Case;
struct RegionCase;

/// By which probes know a region: its name, or else those of a mesh file, "core+shell"; empty where
/// it is given by a formula alone.
std::string called(const RegionCase &region);

/// How it is listed: by its name, or else by the names of a mesh file, or its formula.
std::string listed_as(const RegionCase &region);

/// Throws CaseError where a probe's name cannot be that of a file, or is another one's, and where
/// it names a region that there is not, or that is not the only one of the name.
void check_probes(const Case &asked);

}  // namespace tourmaline::casefile
