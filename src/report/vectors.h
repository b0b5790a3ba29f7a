#pragma once

#include "tourmaline/vector.h"

namespace tourmaline::report {

inline Vector3 from_to(const Vector3 &a, const Vector3 &b) {
  return {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
}

inline Vector3 cross(const Vector3 &a, const Vector3 &b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

inline double dot(const Vector3 &a, const Vector3 &b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

}  // namespace tourmaline::report
