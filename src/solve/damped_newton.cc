#include "solve/damped_newton.h"

#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace tourmaline::solve {

using Place = NaturalMap::Place;
using Direction = NaturalMap::Direction;

namespace {

// The length at which the merit is least, of the whole one, halved ones and those at which points
// change their branch; 0 where it does not fall enough.
double damped(const NaturalMap &map, const Place &x, const Direction &direction) {
  constexpr double armijo = 1e-4;
  const double merit = map.merit(x);
  double best = 1, least = map.merit(map.along(x, direction, 1));
  if (least <= (1 - 2 * armijo) * merit)
    return 1;
  std::vector<double> lengths = map.turns(x, direction);
  constexpr int halvings = 13;
  for (int k = 1; k <= halvings; ++k)
    lengths.push_back(std::ldexp(1., -k));
  for (const double t : lengths)
    if (const double value = map.merit(map.along(x, direction, t)); value < least) {
      least = value;
      best = t;
    }
  return least <= (1 - 2 * armijo * best) * merit ? best : 0;
}

}  // namespace

void polish(const NaturalMap &map, Place &x, int steps, IterationCount &count) {
  for (int k = 0; k < steps; ++k) {
    const std::optional<Direction> direction = map.newton_direction(x, true);
    ++count.made;
    if (!direction)
      return;
    Place next = map.settled(map.arrived(map.along(x, *direction, 1)));
    if (!(map.residual(next) < map.residual(x)))
      return;
    x = std::move(next);
  }
}

bool damped_newton(const NaturalMap &map, Place &x, double tolerance, int most,
                   IterationCount &count) {
  for (int k = 0; !map.is_zero(x, tolerance); ++k) {
    if (k == most || !count.is_left())
      return false;
    const std::optional<Direction> direction = map.newton_direction(x);
    ++count.made;
    if (!direction)
      return false;
    const double length = damped(map, x, *direction);
    if (length == 0)
      return false;
    x = map.arrived(map.along(x, *direction, length));
  }
  x = map.settled(x);
  if (map.is_solved_in_part() && !map.is_zero(x, next_to_nothing * tolerance))
    polish(map, x, 1, count);
  return map.is_zero(x, tolerance);
}

}  // namespace tourmaline::solve
