#include "report/scale.h"

#include <algorithm>
#include <cmath>

#include "report/number_text.h"

namespace tourmaline::report {
namespace {

double greatest_displacement(const Result &result) {
  const Field *u = result.field("displacement");
  if (!u)
    return 0;
  double greatest = 0;
  for (std::size_t i = 0; i < u->values.front().size(); ++i) {
    double square = 0;
    for (const std::vector<float> &component : u->values)
      square += static_cast<double>(component[i]) * component[i];
    greatest = std::max(greatest, std::sqrt(square));
  }
  return greatest;
}

double usual_strain(const Result &result) {
  const Field *strain = result.field("strain");
  double largest = 0;
  for (std::size_t c = 0; strain && c < strain->values.size(); ++c) {
    const Quantiles usual = usual_range(result, *strain, c, 0.01);
    largest = std::max({largest, -usual.low, usual.high});
  }
  return largest;
}

}  // namespace

Quantiles usual_range(const Result &result, const Field &field, std::size_t component,
                      double share) {
  const std::vector<float> &all = field.values[component];
  const std::size_t places = all.size() / result.times.size();
  std::vector<float> last(all.end() - static_cast<std::ptrdiff_t>(places), all.end());
  if (last.empty())
    return {};
  std::sort(last.begin(), last.end());
  const double end = static_cast<double>(last.size() - 1);
  return {last[static_cast<std::size_t>(share * end)],
          last[static_cast<std::size_t>(std::ceil((1 - share) * end))]};
}

namespace {

/// Values differ by less than what single precision tells apart.
constexpr double same = 4e-7;

/// Empty where the values between `low` and `high` have a range to be shown.
std::string no_range(double low, double high, const Field &field) {
  const double size = std::max(-low, high);
  const auto with_unit = [&](double value) {
    return number_text(value, 4) + (field.unit.empty() ? "" : " " + field.unit);
  };
  if (low == 0 && high == 0)
    return "0 everywhere";
  if (high - low <= same * size)
    return "constant, " + with_unit((low + high) / 2);
  return field.below_round_off ? "below round-off, at most " + with_unit(size) : "";
}

}  // namespace

ShownRange shown_range(const Result &result, const Field &field, std::size_t component) {
  const std::vector<float> &all = field.values[component];
  const auto places = static_cast<std::ptrdiff_t>(all.size() / result.times.size());
  const auto [low, high] = std::minmax_element(all.end() - places, all.end());
  ShownRange range{*low, *high, false, false, no_range(*low, *high, field)};
  if (field.is_unknown() || !range.instead.empty())
    return range;
  const Quantiles usual = usual_range(result, field, component, 0.03);
  const double size = std::max(-usual.low, usual.high);
  range.cut_above = usual.high > 0 && range.high - usual.high > size / 2;
  range.cut_below = usual.low < 0 && usual.low - range.low > size / 2;
  if (range.cut_above)
    range.high = usual.high;
  if (range.cut_below)
    range.low = usual.low;
  return range;
}

double size_of(const Result &result) {
  double size = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto [low, high] =
        std::minmax_element(result.points.begin(), result.points.end(),
                            [axis](auto &a, auto &b) { return a[axis] < b[axis]; });
    size = std::max(size, (*high)[axis] - (*low)[axis]);
  }
  return size;
}

double suitable_scale(const Result &result) {
  const double largest = greatest_displacement(result);
  if (!(largest > 0))
    return 1;
  const double wanted =
      std::min(0.1 * size_of(result) / largest, 0.9 / std::max(usual_strain(result), 1e-300));
  const double power = std::pow(10, std::floor(std::log10(wanted)));
  for (const int digit : {8, 6, 5, 4, 3, 2})
    if (digit * power <= wanted * 1.000001)
      return digit * power;
  return power;
}

}  // namespace tourmaline::report
