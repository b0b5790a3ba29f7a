#pragma once

#include <span>
#include <vector>

#include "output/records.h"

namespace tourmaline::output {

/// Of a body along an axis [m].
double largest_extent(std::span<const Vector3> points);

/// Indices of the points in the order x, then y, then z; coordinates that differ by less than 1e-9
/// of the largest extent count as equal, so round-off in a mesh does not shuffle rows.
std::vector<std::size_t> sorted_by_place(const std::vector<Vector3> &points);

}  // namespace tourmaline::output
