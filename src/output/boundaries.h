#pragma once

#include <string>
#include <vector>

#include "output/records.h"

namespace tourmaline::output {

/// {"boundaries": [{"name": ..., "facets": [[node, ...], ...]}, ...]}
std::string boundaries_text(const std::vector<NamedBoundary> &boundaries);

}  // namespace tourmaline::output
