#include "report/ticks.h"

#include <cmath>

namespace tourmaline::report {

std::vector<double> ticks(double low, double high) {
  const double power = std::pow(10, std::floor(std::log10((high - low) / 4)));
  double step = power;
  for (const double digit : {2., 5., 10.})
    if ((high - low) / step > 6)
      step = digit * power;
  std::vector<double> values;
  const auto first = static_cast<long>(std::ceil(low / step - 1e-9)),
             last = static_cast<long>(std::floor(high / step + 1e-9));
  for (long i = first; i <= last; ++i)
    values.push_back(static_cast<double>(i) * step);
  return values;
}

std::vector<double> logarithmic_ticks(double low, double high) {
  const auto multiples = [&](const std::vector<double> &digits) {
    std::vector<double> values;
    const auto first = static_cast<int>(std::floor(std::log10(low))),
               last = static_cast<int>(std::ceil(std::log10(high)));
    for (int power = first; power <= last; ++power)
      for (const double digit : digits)
        if (const double value = digit * std::pow(10, power);
            value >= low * (1 - 1e-9) && value <= high * (1 + 1e-9))
          values.push_back(value);
    return values;
  };
  constexpr std::size_t most = 12;
  const std::vector<double> all = multiples({1});
  std::vector<double> powers;
  for (std::size_t i = 0; i < all.size(); i += (all.size() + most - 1) / most)
    powers.push_back(all[i]);
  return powers.size() < 2 ? multiples({1, 2, 5}) : powers;
}

}  // namespace tourmaline::report
