#include "sweep/reduction.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace tourmaline::sweep {

namespace {

using Kind = Reduction::Kind;

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// What counts of the steps, and their shares in the time of all that counts.
struct Counted {
  std::vector<double> values, shares;
};

Counted counted(const std::optional<Reduction::Window> &window, std::span<const double> times,
                std::span<const double> values) {
  Counted found;
  double before = 0, total = 0;
  for (std::size_t i = 0; i < values.size(); before = times[i++]) {
    const double begin = window ? std::max(before, window->from) : before;
    const double end = window ? std::min(times[i], window->to) : times[i];
    // Ends of steps are i*k, which a window as somebody writes it need not meet to the last bit.
    if (window && !(end - begin > 1e-9 * (times[i] - before)))
      continue;
    found.values.push_back(values[i]);
    found.shares.push_back(end - begin);
    total += end - begin;
  }
  for (double &share : found.shares)
    share /= total;
  return found;
}

// Scaled by the greatest, so that no square leaves the range of numbers.
double rms(const Counted &steps) {
  double greatest = 0;
  for (const double value : steps.values)
    greatest = std::max(greatest, std::abs(value));
  if (greatest == 0)
    return 0;
  double sum = 0;
  for (std::size_t i = 0; i < steps.values.size(); ++i)
    sum += steps.shares[i] * std::pow(steps.values[i] / greatest, 2);
  return greatest * std::sqrt(sum);
}

double mean(const Counted &steps) {
  double sum = 0;
  for (std::size_t i = 0; i < steps.values.size(); ++i)
    sum += steps.shares[i] * steps.values[i];
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
  if (values.empty() || values.size() != times.size())
    return none;
  if (reduction.kind == Kind::last)
    return values.back();
  if (reduction.kind == Kind::at)
    return value_at(reduction.time, times, values);
  const Counted steps = counted(reduction.window, times, values);
  if (steps.values.empty() || std::any_of(steps.values.begin(), steps.values.end(),
                                          [](double value) { return std::isnan(value); }))
    return none;
  switch (reduction.kind) {
    case Kind::min:
      return *std::min_element(steps.values.begin(), steps.values.end());
    case Kind::max:
      return *std::max_element(steps.values.begin(), steps.values.end());
    case Kind::mean:
      return mean(steps);
    default:
      return rms(steps);
  }
}

}  // namespace tourmaline::sweep
