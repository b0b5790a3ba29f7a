// What this machine can do on one thread, the floors that bench/results.md compares with. Prints
// JSON. With `--take N` it only takes N bytes of memory and gives them back, so that what runs next
// finds them at hand.

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>

#include "condensation/pages.h"
#include "run/dense_kernels.h"
#include "run/machine_speed.h"
#include "stopwatch.h"

namespace {

void take(std::size_t bytes) {
  const tourmaline::condensation::Pages pages(bytes / sizeof(double));
  std::fill_n(pages.data(), pages.size(), 1.);
}

// Bytes a second of memory that nobody has had for a while: a virtual machine may have to be given
// it first.
double taking_anew() {
  constexpr std::size_t bytes = std::size_t{1} << 30;
  tourmaline::Stopwatch watch;
  take(bytes);
  return double(bytes) / watch.lap();
}

}  // namespace

int main(int argc, char **argv) {
  if (argc == 3 && argv[1] == std::string_view("--take")) {
    take(std::stoull(argv[2]));
    return 0;
  }
  const double taking = taking_anew();
  const tourmaline::run::MachineSpeed speed = tourmaline::run::measured_speed(5);
  fmt::print(
      "{{\"read_bandwidth\": {:.6g}, \"dgemm_rate\": {:.6g}, \"taking_anew\": {:.6g}, "
      "\"blas_kernels\": \"{}\"}}\n",
      speed.reading, speed.operations, taking, tourmaline::run::dense_kernels());
}
