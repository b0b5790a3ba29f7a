#include "case/snapping.h"

#include <fmt/format.h>

#include "case/sides.h"
#include "case/time_steps.h"
#include "tourmaline/case/case.h"

namespace tourmaline::casefile {

namespace {

bool falls(const Case &asked, const ContactCase &contact) {
  const FrictionCoefficientCase &mu = contact.friction.coefficient;
  for (const std::string &name : contact.on)
    for (const SidePoint &at : points_on(asked.mesh, name))
      for (const double time : {TimeSteps(asked.time).at(1), asked.time.end})
        if (mu.at_rest->value(at.point, time) > mu.kinetic->value(at.point, time))
          return true;
  return false;
}

std::string warning(const FrictionCoefficientCase &mu) {
  return fmt::format(
      "{} = {} is above kinetic = {}: friction falls as the contact slips, and where it falls "
      "faster "
      "than the body unloads, slip snaps from one state to another, which a quasistatic simulation "
      "shows as a jump in one step",
      mu.at_rest->where(), mu.at_rest->text(), mu.kinetic->text());
}

}  // namespace

std::vector<std::string> snapping_warnings(const Case &asked) {
  if (asked.time.is_dynamic())  // inertia holds what snaps
    return {};
  std::vector<std::string> warnings;
  for (const ContactCase &contact : asked.contacts)
    if (const FrictionCoefficientCase &mu = contact.friction.coefficient;
        mu.at_rest && mu.kinetic && falls(asked, contact))
      warnings.push_back(warning(mu));
  return warnings;
}

}  // namespace tourmaline::casefile
