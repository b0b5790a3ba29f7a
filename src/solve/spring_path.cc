#include "solve/spring_path.h"

#include <algorithm>
#include <cmath>

namespace tourmaline::solve {

bool follow_springs(const std::function<bool(double stiffness)> &solve) {
  constexpr double softest = 1e-12, stiffest = 10, longest = 10, shortest = 1.3;
  double solved = softest / longest, factor = longest;
  while (solved < stiffest) {
    const double next = std::min(factor * solved, stiffest);
    if (solve(next)) {
      solved = next;
      factor = std::min(factor * factor, longest);
    } else if ((factor = std::sqrt(factor)) < shortest) {
      return false;
    }
  }
  return true;
}

}  // namespace tourmaline::solve
