#include "tourmaline/contact/friction.h"

#include <fmt/format.h>

#include "tourmaline/case/contact_case.h"
#include "tourmaline/error.h"

namespace tourmaline::contact {

namespace {

double bound_at(const casefile::Formula &asked, const ContactPlace &place) {
  const double bound = asked.value(place.point, place.time);
  if (bound < 0)
    throw CaseError(fmt::format(
        "{}: the friction bound is {:g} N/m^2 at ({:g}, {:g}, {:g}), t = {:g} s; "
        "it must be >= 0 (paper, eq. 9)",
        asked.where(), bound, place.point[0], place.point[1], place.point[2], place.time));
  return bound;
}

}  // namespace

FrictionAt friction_of(const casefile::FrictionCase &asked) {
  if (asked.law != "tresca")
    return [](const ContactPlace &) { return Tresca{0}; };
  return
      [bound = asked.bound](const ContactPlace &place) { return Tresca{bound_at(bound, place)}; };
}

}  // namespace tourmaline::contact
