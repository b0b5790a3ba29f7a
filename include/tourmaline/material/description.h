#pragma once

#include <string>

#include "tourmaline/case/case.h"

namespace tourmaline::material {

/// One line an entry of the built-in library, or of a file of materials.
std::string describe_library(const std::string &file = {});

/// What `tourmaline materials NAME` prints: the entry's constants with units and source, the
/// expanded tensors in the stress-charge and in the strain-charge form, coupling factors and
/// warnings.
std::string describe(const casefile::MaterialCase &asked);

}  // namespace tourmaline::material
