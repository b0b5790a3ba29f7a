#include "contact/exchange.h"

#include <algorithm>

namespace tourmaline::contact {

double Ramp::value(double penetration) const {
  return length_ ? std::clamp(1 + penetration / *length_, 0., 1.) : 1;
}

double Ramp::derivative(double penetration) const {
  return length_ && penetration > -*length_ && penetration < 0 ? 1 / *length_ : 0;
}

}  // namespace tourmaline::contact
