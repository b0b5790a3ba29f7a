#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "report/result.h"

namespace tourmaline::report {

/// Sides of triangles of a solid body's skin, by its nodes, at which faces meet at more than 30
/// degrees: they show its shape where colours are not shaded. The counterpart of
/// web/src/feature_edges.ts.
std::vector<std::array<std::uint32_t, 2>> feature_edges(const Result &result);

}  // namespace tourmaline::report
