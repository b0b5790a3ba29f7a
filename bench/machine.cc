// What this machine can do on one thread, the floors that bench/results.md compares with. Prints
// JSON.

#include <fmt/format.h>

#include "run/dense_kernels.h"
#include "run/machine_speed.h"

int main() {
  const tourmaline::run::MachineSpeed speed = tourmaline::run::measured_speed(5);
  fmt::print("{{\"read_bandwidth\": {:.6g}, \"dgemm_rate\": {:.6g}, \"blas_kernels\": \"{}\"}}\n",
             speed.reading, speed.operations, tourmaline::run::dense_kernels());
}
