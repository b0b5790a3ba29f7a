#pragma once

#include <string>
#include <vector>

#include "tourmaline/report/colour_map.h"
#include "tourmaline/report/result.h"

namespace tourmaline::report {

/// Boundaries with the same conditions, and the colour that they share. Colours tell apart for all
/// eyes (Okabe and Ito).
struct SettingGroup {
  Colour colour;
  std::vector<const Boundary *> boundaries;
};

/// Contact first, then prescribed displacements, tractions, the rest.
std::vector<SettingGroup> groups_of(const Result &result);

}  // namespace tourmaline::report
