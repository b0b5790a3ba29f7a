#pragma once

#include <array>
#include <string>
#include <vector>

namespace tourmaline::casefile {

struct Case;

/// A point of the body [m] whose displacement along `direction`, a unit vector, is prescribed.
struct Support {
  std::array<double, 3> point{};
  std::array<double, 3> direction{};
};

/// The rigid motions that the supports leave free: "a translation along x", "a rotation in the
/// plane", "a rotation about an axis parallel to z". Empty when the body is held. In two dimensions
/// the third coordinates are not looked at.
std::vector<std::string> free_motions(int dimension, const std::vector<Support> &supports);

/// Throws CaseError when the case's conditions leave the box a rigid motion (bilateral contact
/// holds the normal direction) or the electric potential a constant: such a problem has no unique
/// solution.
void check_holding(const Case &asked);

}  // namespace tourmaline::casefile
