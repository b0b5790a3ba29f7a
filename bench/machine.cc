// What this machine can do on one thread, the floors that bench/results.md compares with. Prints
// JSON.

#include <fmt/format.h>

#include <algorithm>

#include "condensation/pages.h"
#include "run/dense_kernels.h"
#include "run/machine_speed.h"
#include "stopwatch.h"

namespace {

// Bytes a second of memory that nobody has had for a while: a virtual machine may have to be given
// it first.
double taking_anew() {
  constexpr std::size_t bytes = std::size_t{1} << 30;
  tourmaline::Stopwatch watch;
  const tourmaline::condensation::Pages pages(bytes / sizeof(double));
  std::fill_n(pages.data(), pages.size(), 1.);
  return double(bytes) / watch.lap();
}

}  // namespace

int main() {
  const double taking = taking_anew();
  const tourmaline::run::MachineSpeed speed = tourmaline::run::measured_speed(5);
  fmt::print(
      "{{\"read_bandwidth\": {:.6g}, \"dgemm_rate\": {:.6g}, \"taking_anew\": {:.6g}, "
      "\"blas_kernels\": \"{}\"}}\n",
      speed.reading, speed.operations, taking, tourmaline::run::dense_kernels());
}
