#include "sweep/reduction.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tourmaline::sweep {

namespace {

using Kind = Reduction::Kind;

constexpr double none = std::numeric_limits<double>::quiet_NaN();

// Scaled by the greatest, so that no square leaves the range of numbers.
double rms(std::span<const double> times, std::span<const double> values) {
  double greatest = 0;
  for (const double value : values)
    greatest = std::max(greatest, std::abs(value));
  if (greatest == 0)
    return 0;
  double sum = 0, before = 0;
  for (std::size_t i = 0; i < values.size(); before = times[i++])
    sum += (times[i] - before) * std::pow(values[i] / greatest, 2);
  return greatest * std::sqrt(sum / times.back());
}

double mean(std::span<const double> times, std::span<const double> values) {
  double sum = 0, before = 0;
  for (std::size_t i = 0; i < values.size(); before = times[i++])
    sum += (times[i] - before) / times.back() * values[i];
  return sum;
}

double value_at(double time, std::span<const double> times, std::span<const double> values) {
  // The end of a step is i*k, which 0.3 as somebody writes it need not be to the last bit.
  const double rounding = 1e-9 * times.front();
  for (std::size_t i = 0; i < times.size(); ++i)
    if (std::abs(times[i] - time) <= rounding)
      return values[i];
  const auto next = std::upper_bound(times.begin(), times.end(), time);
  if (next == times.begin() || next == times.end())
    return none;
  const auto i = static_cast<std::size_t>(next - times.begin());
  const double part = (time - times[i - 1]) / (times[i] - times[i - 1]);
  return (1 - part) * values[i - 1] + part * values[i];
}

}  // namespace

const std::vector<std::string> &reduction_words() {
  static const std::vector<std::string> words{"last", "min", "max", "mean", "rms"};
  return words;
}

std::optional<Reduction> reduction_named(const std::string &word) {
  const std::vector<std::string> &words = reduction_words();
  const auto found = std::find(words.begin(), words.end(), word);
  if (found == words.end())
    return std::nullopt;
  return Reduction{.kind = static_cast<Kind>(found - words.begin())};
}

double reduced(const Reduction &reduction, std::span<const double> times,
               std::span<const double> values) {
  const bool has_gap =
      std::any_of(values.begin(), values.end(), [](double value) { return std::isnan(value); });
  if (values.empty() || values.size() != times.size())
    return none;
  if (reduction.kind == Kind::last)
    return values.back();
  if (has_gap && reduction.kind != Kind::at)
    return none;
  switch (reduction.kind) {
    case Kind::min:
      return *std::min_element(values.begin(), values.end());
    case Kind::max:
      return *std::max_element(values.begin(), values.end());
    case Kind::mean:
      return mean(times, values);
    case Kind::rms:
      return rms(times, values);
    default:
      return value_at(reduction.time, times, values);
  }
}

}  // namespace tourmaline::sweep
