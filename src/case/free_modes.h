#pragma once

#include <array>
#include <vector>

#include "case/holding.h"

namespace tourmaline::casefile {

/// v(p) = translation + rotation x (p - centre). In two dimensions rotation is about z.
struct RigidMotion {
  std::array<double, 3> translation{}, rotation{}, centre{};

  std::array<double, 3> at(const std::array<double, 3> &point) const;
};

/// Independent motions that span all that the supports leave free, about the body's `centre` and of
/// order one within its `size` [m]. Empty when the body is held.
std::vector<RigidMotion> free_modes(const Case &asked, const std::vector<Support> &supports,
                                    const std::array<double, 3> &centre, double size);

}  // namespace tourmaline::casefile
