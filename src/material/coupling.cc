#include "material/coupling.h"

#include <algorithm>
#include <cmath>

#include "dense/decompositions.h"

namespace tourmaline::material {

Tensor clamped_part(const Constants &c) {
  return c.piezoelectric * dense::inverse(c.stiffness) * c.piezoelectric.transpose();
}

double coupling_factor(const Tensor &clamped, const Tensor &free) {
  return std::sqrt(std::max(0., dense::eigenvalues(clamped, free)[2]));
}

double coupling_factor(const Constants &c) {
  const Tensor clamped = clamped_part(c);
  return coupling_factor(clamped, c.permittivity + clamped);
}

}  // namespace tourmaline::material
