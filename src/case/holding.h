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

/// Those of the case's body: one of revolution moves rigidly along its axis, y, and not otherwise.
std::vector<std::string> free_motions(const Case &asked, const std::vector<Support> &supports);

/// The same as a phrase, "a translation along x and a rotation in the plane".
std::string free_motions_in_words(const Case &asked, const std::vector<Support> &supports);

/// Throws CaseError when the case's conditions, with all that its contact can hold, leave the body
/// a rigid motion, or the electric potential a constant: such a problem has no unique solution.
void check_holding(const Case &asked);

/// The rigid motions that only friction or contact that may open keep the body from, as a phrase;
/// empty where there are none.
std::string left_to_contact(const Case &asked);

}  // namespace tourmaline::casefile
