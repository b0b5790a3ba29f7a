#pragma once

#include <array>

namespace tourmaline {

/// A place [m] or a vector in space by its components along x, y, z; z = 0 in 2D.
using Vector3 = std::array<double, 3>;

}  // namespace tourmaline
