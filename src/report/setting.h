#pragma once

#include <string>
#include <vector>

#include "report/colour_map.h"
#include "report/result.h"

namespace tourmaline::report {

/// Boundaries with the same conditions, and the colour that they share. Colours tell apart for all
/// eyes (Okabe and Ito).
struct SettingGroup {
  Colour colour;
  std::vector<const Boundary *> boundaries;
};

/// Contact first, then prescribed displacements, tractions, the rest.
std::vector<SettingGroup> groups_of(const Result &result);

/// Whether the boundary has facets that no name holds (`mesh.unnamed = "natural"`), with nothing
/// said of them.
bool has_unnamed_facets(const Result &result);

/// What a legend calls them: "other sides", "other faces".
std::string name_of_unnamed(const Result &result);

/// A region and what it consists of, in words for a legend.
struct Part {
  std::string name, material;
};

/// The regions in the order of the case; empty where the body is one.
std::vector<Part> parts_of(const Result &result);

}  // namespace tourmaline::report
