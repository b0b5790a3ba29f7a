#pragma once

#include "tourmaline/contact/friction.h"

namespace tourmaline::contact {

/// A law whose set is `share` > 0 times that of `law`: what a point bears that only just touches.
Friction shared(const Friction &law, double share);

}  // namespace tourmaline::contact
