#pragma once

#include "tourmaline/contact/friction.h"

namespace tourmaline::contact {

inline Tangent along(double x) {
  return Tangent::Constant(1, x);
}

inline Tangent plane(double x, double y) {
  Tangent t(2);
  t << x, y;
  return t;
}

}  // namespace tourmaline::contact
