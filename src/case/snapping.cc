#include "case/snapping.h"

#include <fmt/format.h>

#include "case/sides.h"
#include "tourmaline/case/case.h"

namespace tourmaline::casefile {

namespace {

bool falls(const Case &asked, const FrictionCoefficientCase &mu) {
  for (const std::string &name : asked.contact->on)
    for (const SidePoint &at : points_on(asked.mesh, name))
      for (const double time : {asked.time.end / asked.time.steps, asked.time.end})
        if (mu.at_rest->value(at.point, time) > mu.kinetic->value(at.point, time))
          return true;
  return false;
}

}  // namespace

std::string snapping_warning(const Case &asked) {
  if (!asked.contact || asked.contact->friction.law != "coulomb")
    return "";
  const FrictionCoefficientCase &mu = asked.contact->friction.coefficient;
  if (!mu.at_rest || !mu.kinetic || !falls(asked, mu))
    return "";
  return fmt::format(
      "{} = {} is above kinetic = {}: friction falls as the contact slips, and where it falls "
      "faster "
      "than the body unloads, slip snaps from one state to another, which a quasistatic simulation "
      "shows as a jump in one step",
      mu.at_rest->where(), mu.at_rest->text(), mu.kinetic->text());
}

}  // namespace tourmaline::casefile
