// What this machine can do on one thread, the floors that bench/results.md compares with: reading
// memory, and OpenBLAS's matrix product. Prints JSON.

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdio>
#include <vector>

extern "C" {
void dgemm_(const char *, const char *, const int *, const int *, const int *, const double *,
            const double *, const int *, const double *, const int *, const double *, double *,
            const int *);
void openblas_set_num_threads(int);
char *openblas_get_corename();
}

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// Bytes a second of a sum over 512 MiB, the best of five; several partial sums, so that additions
// do not bound it.
double read_bandwidth() {
  const std::vector<double> data(std::size_t{1} << 26, 1.);
  double best = 0;
  volatile double sink = 0;
  for (int repeat = 0; repeat < 5; ++repeat) {
    const auto start = Clock::now();
    double sum[16] = {};
    for (std::size_t i = 0; i < data.size(); i += 16)
      for (int k = 0; k < 16; ++k)
        sum[k] += data[i + k];
    for (const double s : sum)
      sink = sink + s;
    best = std::max(best, 8. * static_cast<double>(data.size()) / seconds_since(start));
  }
  return best;
}

// Operations a second of a 1500 x 1500 product, the best of five.
double dgemm_rate() {
  const int n = 1500;
  const double one = 1;
  std::vector<double> a(n * n, 1.), b(n * n, 1.), c(n * n, 0.);
  double best = 0;
  for (int repeat = 0; repeat < 5; ++repeat) {
    const auto start = Clock::now();
    dgemm_("N", "N", &n, &n, &n, &one, a.data(), &n, b.data(), &n, &one, c.data(), &n);
    best = std::max(best, 2. * n * n * n / seconds_since(start));
  }
  return best;
}

}  // namespace

int main() {
  openblas_set_num_threads(1);
  std::printf("{\"read_bandwidth\": %.6g, \"dgemm_rate\": %.6g, \"blas_kernels\": \"%s\"}\n",
              read_bandwidth(), dgemm_rate(), openblas_get_corename());
}
