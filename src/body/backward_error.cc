#include "tourmaline/body/backward_error.h"

#include <algorithm>
#include <cmath>

namespace tourmaline::body {

template <int dim>
double backward_error(const Operator<dim> &op, double step, const std::vector<double> &scale,
                      std::span<const double> residual, std::span<const double> right_side,
                      std::span<const double> state) {
  const std::vector<double> row_sums = op.sizes(step, scale);
  double largest_r = 0, norm = 0, largest_x = 0, largest_b = 0;
  for (std::size_t i = 0; i < scale.size(); ++i) {
    if (scale[i] == 0)
      continue;
    norm = std::max(norm, row_sums[i] * scale[i]);
    largest_r = std::max(largest_r, std::abs(residual[i]) * scale[i]);
    largest_b = std::max(largest_b, std::abs(right_side[i]) * scale[i]);
    largest_x = std::max(largest_x, std::abs(state[i]) / scale[i]);
  }
  const double size = norm * largest_x + largest_b;
  return size > 0 ? largest_r / size : 0;
}

template double backward_error(const Operator<2> &, double, const std::vector<double> &,
                               std::span<const double>, std::span<const double>,
                               std::span<const double>);
template double backward_error(const Operator<3> &, double, const std::vector<double> &,
                               std::span<const double>, std::span<const double>,
                               std::span<const double>);

}  // namespace tourmaline::body
