#pragma once

#include <string>
#include <vector>

#include "output/summary.h"

namespace tourmaline::casefile {
struct Case;
}

namespace tourmaline::run {

/// The materials of the body, by region.
std::vector<output::MaterialRecord> materials_of(const casefile::Case &asked);

/// What a case amounts to, as comments of a case file: the materials with the couplings that they
/// have and have not; where there is a mesh file or are regions, size and centre of every boundary
/// and region and direction of poling of the regions. Builds the mesh for that; throws CaseError
/// for cells in no region or in several.
std::string survey(const casefile::Case &asked);

}  // namespace tourmaline::run
