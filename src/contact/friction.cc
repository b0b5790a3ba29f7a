#include "tourmaline/contact/friction.h"

#include "contact/kinds.h"

namespace tourmaline::contact {

FrictionAt friction_of(const casefile::FrictionCase &asked) {
  return [asked, at = kind_of(asked).at](const ContactPlace &place) -> Friction {
    return at ? at(asked, place) : Tresca{};
  };
}

}  // namespace tourmaline::contact
