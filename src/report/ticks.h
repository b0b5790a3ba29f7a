#pragma once

#include <vector>

namespace tourmaline::report {

/// About five round numbers between the two.
std::vector<double> ticks(double low, double high);

/// Powers of ten between the two, which are greater than 0; where there are fewer than two of them,
/// also twice and five times those.
std::vector<double> logarithmic_ticks(double low, double high);

}  // namespace tourmaline::report
