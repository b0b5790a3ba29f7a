#pragma once

#include <string>

#include "tourmaline/case/case.h"

namespace tourmaline::solve {

/// What a mesh file and the regions of a case amount to, as comments of a case file: size and
/// centre of every boundary and region, material and direction of poling of the regions. Empty for
/// a box of one material. Builds the mesh; throws CaseError for cells in no region or in several.
std::string survey(const casefile::Case &asked);

}  // namespace tourmaline::solve
