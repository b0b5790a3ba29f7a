#pragma once

#include <string>
#include <vector>

#include "output/records.h"

namespace tourmaline::output {

/// {"boundaries": [{"name": ..., "facets": [[node, ...], ...]}, ...]}; faces by their corners
std::string boundaries_text(const std::vector<NamedBoundary> &boundaries);

}  // namespace tourmaline::output
