#pragma once

#include <string>

#include "tourmaline/contact/friction.h"

namespace tourmaline::contact {

/// The laws that a program brings along under a name, with every answer looked at: a law that gives
/// another number of components than it was asked for, numbers that are not finite, a status that
/// is not that of its traction, or throws anything but this library's errors, is refused with a
/// CaseError that names the law and the place. (Lack of memory stays std::bad_alloc.)
FrictionAt checked(FrictionAt laws, std::string name);

}  // namespace tourmaline::contact
