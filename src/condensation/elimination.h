#pragma once

#include <cstddef>
#include <vector>

#include "condensation/grouped_matrix.h"

namespace tourmaline::condensation {

/// What a front eliminates and whom it hands the rest to. Its rows are its pivots, then those of
/// `Elimination::below`. Variables are told by their place in the order of elimination.
struct Front {
  int first = 0;         ///< place of its first pivot
  int pivots = 0;        ///< 0 at the front of what is kept
  int positive = 0;      ///< of the pivots the first ones, where the diagonal is positive
  int below = 0;         ///< rows that it does not eliminate
  int parent = -1;       ///< the front that takes these; -1: there are none
  std::size_t rows = 0;  ///< where they begin in `Elimination::below`

  int height() const { return pivots + below; }
  /// Numbers in its columns of L.
  long long entries() const {
    return static_cast<long long>(pivots) * below + pivots * (pivots + 1LL) / 2;
  }
  /// Multiplications and additions that eliminate its pivots.
  double operations() const;
  /// What a front of such a size takes in a run of some tens of steps.
  static double seconds(double pivots, double below);
};

/// The multifrontal elimination of a quasi-definite matrix before any number is known (Liu, SIAM
/// Review 34, 1992): its tree of fronts, children before parents, and what it will take. The signs
/// of the pivots are those of the diagonal, whatever the order. In a front the positive ones come
/// first.
struct Elimination {
  Elimination() = default;
  explicit Elimination(const GroupedMatrix &matrix);

  std::vector<Front> fronts;
  std::vector<int> group_first;  ///< by front the first of its groups in `groups`; and their end
  std::vector<int> groups;       ///< of all fronts, those that it eliminates; then what is kept
  std::vector<int> below;        ///< places of the rows below all fronts
  std::vector<int> in_parent;    ///< the same rows in the parent's numbering of its own
  std::vector<int> child_first, children;  ///< by front, likewise
  std::vector<int> place;                  ///< by variable
  std::vector<int> variable;               ///< by place
  std::vector<double> diagonal;            ///< by variable
};

}  // namespace tourmaline::condensation
