#include "tourmaline/contact/friction.h"

#include <fmt/format.h>

#include "tourmaline/error.h"

namespace tourmaline::contact {

Friction friction_at(const casefile::FrictionCase &asked, const output::Vector &point,
                     double time) {
  if (asked.law == "none")
    return Tresca{0};
  const double bound = asked.bound.value(point, time);
  if (bound < 0)
    throw CaseError(
        fmt::format("{}: the friction bound is {:g} N/m^2 at ({:g}, {:g}, {:g}), t = {:g} s; "
                    "it must be >= 0 (paper, eq. 9)",
                    asked.bound.where(), bound, point[0], point[1], point[2], time));
  return Tresca{bound};
}

}  // namespace tourmaline::contact
