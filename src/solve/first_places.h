#pragma once

#include <cstddef>
#include <functional>
#include <string>

#include "tourmaline/vector.h"

namespace tourmaline::solve {

/// " (x, y, z)" [m] for each of the first three of n places, for a message.
std::string first_places(std::size_t n, const std::function<Vector3(std::size_t)> &place);

}  // namespace tourmaline::solve
