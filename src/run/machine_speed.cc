#include "run/machine_speed.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cstddef>
#include <vector>

#include "condensation/pages.h"
#include "stopwatch.h"

namespace tourmaline::run {

namespace {

// Two numbers at once, as every processor has them, and several partial sums: by themselves
// additions would bound it, and not every optimisation would see that.
double seconds_to_read(const double *data, std::size_t n) {
  using Two [[gnu::vector_size(16), gnu::may_alias]] = double;
  constexpr std::size_t width = 8;
  Stopwatch watch;
  Two sums[width] = {};
  for (std::size_t i = 0; i < n; i += 2 * width)
    for (std::size_t k = 0; k < width; ++k)
      sums[k] += *reinterpret_cast<const Two *>(data + i + 2 * k);
  const double seconds = watch.lap();
  volatile double sink = 0;
  for (const Two &sum : sums)
    sink = sink + sum[0] + sum[1];
  return seconds;
}

double seconds_to_multiply(const Eigen::MatrixXd &a, Eigen::MatrixXd &product) {
  Stopwatch watch;
  product.noalias() = a * a;
  return watch.lap();
}

}  // namespace

MachineSpeed measured_speed(int trials) {
  constexpr std::size_t n_numbers = std::size_t{1} << 24;  // more than caches hold
  constexpr Eigen::Index n = 800;
  constexpr double bytes = sizeof(double) * double(n_numbers);
  const Eigen::MatrixXd a = Eigen::MatrixXd::Ones(n, n);
  Eigen::MatrixXd product(n, n);
  MachineSpeed best;
  for (int trial = 0; trial < trials; ++trial) {
    Stopwatch watch;
    condensation::Pages pages(n_numbers);
    std::fill_n(pages.data(), n_numbers, 1.);
    best.taking = std::max(best.taking, bytes / watch.lap());
    for (int again = 0; again < 4; ++again)
      best.reading = std::max(best.reading, bytes / seconds_to_read(pages.data(), n_numbers));
    best.operations = std::max(best.operations, 2. * n * n * n / seconds_to_multiply(a, product));
  }
  return best;
}

}  // namespace tourmaline::run
