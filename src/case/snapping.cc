#include "case/snapping.h"

#include <fmt/format.h>

#include "case/sides.h"
#include "case/time_steps.h"
#include "tourmaline/case/case.h"

namespace tourmaline::casefile {

namespace {

// Whether the coefficient at rest is above the kinetic one, or `below` it, somewhere on the
// contact.
bool is_above(const Case &asked, const ContactCase &contact, bool below = false) {
  const FrictionCoefficientCase &mu = contact.friction.coefficient;
  for (const std::string &name : contact.on)
    for (const SidePoint &at : points_on(asked.mesh, name))
      for (const double time : {TimeSteps(asked.time).at(1), asked.time.end}) {
        const double falls = mu.at_rest->value(at.point, time) - mu.kinetic->value(at.point, time);
        if (below ? falls < 0 : falls > 0)
          return true;
      }
  return false;
}

std::string warning(const FrictionCoefficientCase &mu, const char *which, const char *follows) {
  return fmt::format("{} = {} is {} kinetic = {}: {}", mu.at_rest->where(), mu.at_rest->text(),
                     which, mu.kinetic->text(), follows);
}

}  // namespace

std::vector<std::string> snapping_warnings(const Case &asked) {
  constexpr const char *snaps =
      "friction falls as the contact slips, and where it falls faster than the body unloads, slip "
      "snaps from one state to another, which a quasistatic simulation shows as a jump in one step";
  constexpr const char *grows =
      "friction grows as the contact slips, and nothing snaps; of most pairs of materials it is "
      "the other way round";
  std::vector<std::string> warnings;
  for (const ContactCase &contact : asked.contacts) {
    const FrictionCoefficientCase &mu = contact.friction.coefficient;
    if (!mu.at_rest || !mu.kinetic)
      continue;
    if (is_above(asked, contact)) {
      if (!asked.time.is_dynamic())  // inertia holds what snaps
        warnings.push_back(warning(mu, "above", snaps));
    } else if (is_above(asked, contact, true)) {
      warnings.push_back(warning(mu, "below", grows));
    }
  }
  return warnings;
}

}  // namespace tourmaline::casefile
