#include "material/coupling.h"

#include <algorithm>
#include <cmath>

namespace tourmaline::material {

Tensor clamped_part(const Constants &c) {
  return c.piezoelectric * c.stiffness.ldlt().solve(c.piezoelectric.transpose());
}

double coupling_factor(const Tensor &clamped, const Tensor &free) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<Tensor> shares(clamped, free,
                                                                Eigen::EigenvaluesOnly);
  return std::sqrt(std::max(0., shares.eigenvalues()(2)));
}

double coupling_factor(const Constants &c) {
  const Tensor clamped = clamped_part(c);
  return coupling_factor(clamped, c.permittivity + clamped);
}

}  // namespace tourmaline::material
