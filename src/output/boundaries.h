#pragma once

#include <string>
#include <vector>

#include "output/records.h"

namespace tourmaline::output {

/// {"boundaries": [{"name": ..., "facets": [[node, ...], ...]}, ...]}; faces by their corners. What
/// lies inside, at least in part, has "inside": true.
std::string boundaries_text(const std::vector<NamedBoundary> &boundaries);

}  // namespace tourmaline::output
