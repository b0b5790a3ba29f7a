#include "body/backward_error.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "larger.h"

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
    norm = larger(norm, row_sums[i] * scale[i]);
    largest_r = larger(largest_r, std::abs(residual[i]) * scale[i]);
    largest_b = larger(largest_b, std::abs(right_side[i]) * scale[i]);
    largest_x = larger(largest_x, std::abs(state[i]) / scale[i]);
  }
  std::array<double, 4> all{norm, largest_r, largest_b, largest_x};
  op.sharing().largest(all);
  return relative_to(all[1], all[0] * all[3] + all[2]);
}

template <int dim>
FieldSizes field_sizes(const NodeSharing &sharing, std::span<const double> state,
                       std::span<const double> scale) {
  FieldSizes sizes{};
  for (std::size_t i = 0; i < state.size(); ++i) {
    double &size = sizes[field_of<dim>(i)];
    size = larger(size, std::abs(state[i]) / scale[i % Fields<dim>::count]);
  }
  sharing.largest(sizes);
  return sizes;
}

double relative_size(const FieldSizes &change, const FieldSizes &whole) {
  constexpr double nothing = 1e-6;  // of the largest field
  const double largest = larger(larger(whole[0], whole[1]), whole[2]);
  double worst = 0;
  for (int f = 0; f < 3; ++f)
    worst = larger(worst, relative_to(change[f], larger(whole[f], nothing * largest)));
  return std::isnan(worst) ? std::numeric_limits<double>::infinity() : worst;
}

template FieldSizes field_sizes<2>(const NodeSharing &, std::span<const double>,
                                   std::span<const double>);
template FieldSizes field_sizes<3>(const NodeSharing &, std::span<const double>,
                                   std::span<const double>);
template double backward_error(const Operator<2> &, double, const std::vector<double> &,
                               std::span<const double>, std::span<const double>,
                               std::span<const double>);
template double backward_error(const Operator<3> &, double, const std::vector<double> &,
                               std::span<const double>, std::span<const double>,
                               std::span<const double>);

}  // namespace tourmaline::body
