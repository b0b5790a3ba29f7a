#pragma once

#include "solve/natural_map.h"

namespace tourmaline::solve {

/// Of attempts one after the other, each of which may take some linear systems.
struct IterationCount {
  int made = 0;  ///< linear systems
  int last = 0;  ///< of the attempt

  void begin_attempt(int most) { last = made + most; }
  bool is_left() const { return made < last; }
};

/// Newton's method for a zero of the natural map from x, damped so that the merit falls. Whether it
/// has come there, in at most `most` steps; x is then settled.
bool damped_newton(const NaturalMap &map, NaturalMap::Place &x, double tolerance, int most,
                   IterationCount &count);

/// Up to `steps` more whole ones from a zero x within the tolerance, as long as the residual falls.
void polish(const NaturalMap &map, NaturalMap::Place &x, int steps, IterationCount &count);

}  // namespace tourmaline::solve
