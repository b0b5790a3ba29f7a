#include "solve/conjugate_gradients.h"

#include <cmath>

namespace tourmaline::solve {

namespace {

// Over all ranks.
double sum_over_free(const FreeUnknowns &of, const std::function<double(std::size_t)> &term) {
  const std::size_t n = of.is_free.size(), per_node = n / of.sharing.n_nodes();
  double sum = 0;
  for (std::size_t i = 0; i < n; ++i)
    if (of.is_free[i] && of.sharing.counts(static_cast<body::Node>(i / per_node)))
      sum += term(i);
  return of.sharing.sum(sum);
}

}  // namespace

double FreeUnknowns::size_of(std::span<const double> r) const {
  return sum_over_free(*this, [&](std::size_t i) { return r[i] * r[i] / diagonal[i]; });
}

bool conjugate_gradients(const FreeUnknowns &of, std::vector<double> residual, double enough,
                         std::size_t most, std::vector<double> &x) {
  const std::size_t n = of.is_free.size();
  std::vector<double> direction(n, 0.);
  double size = of.size_of(residual), conjugate = 0;
  for (std::size_t k = 0; !(size <= enough); ++k) {
    if (k == most || !std::isfinite(size))
      return false;
    for (std::size_t i = 0; i < n; ++i)
      if (of.is_free[i])
        direction[i] = residual[i] / of.diagonal[i] + conjugate * direction[i];
    const std::vector<double> taken = of.product(direction);
    const double curvature =
        sum_over_free(of, [&](std::size_t i) { return direction[i] * taken[i]; });
    for (std::size_t i = 0; i < n; ++i)
      if (of.is_free[i]) {
        x[i] += size / curvature * direction[i];
        residual[i] -= size / curvature * taken[i];
      }
    const double next = of.size_of(residual);
    conjugate = next / size;
    size = next;
  }
  return true;
}

}  // namespace tourmaline::solve
