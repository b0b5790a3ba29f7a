#include "report/scale.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "report/number_text.h"
#include "report/vectors.h"

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

/// The first s > 0 at which 1 + b s + c s^2 has fallen to a tenth.
double tenth_at(double b, double c) {
  constexpr double never = std::numeric_limits<double>::max();
  const double inside = b * b - 3.6 * c;
  if (inside < 0)
    return never;
  const double q = -0.5 * (b + (b < 0 ? -1 : 1) * std::sqrt(inside));
  double first = never;
  for (const double root : {c == 0 ? never : q / c, q == 0 ? never : 0.9 / q})
    if (root > 0)
      first = std::min(first, root);
  return first;
}

/// Displacement of one of the skin's nodes in one state.
Vector3 displacement_of(const Field &u, std::size_t at) {
  Vector3 vector{};
  for (std::size_t c = 0; c < u.values.size(); ++c)
    vector[c] = u.values[c][at];
  return vector;
}

/// The largest magnification at which every triangle of the skin keeps a tenth of its area, seen
/// along its normal.
double unfolded_triangles(const Result &result, const Field &u) {
  const std::size_t n = result.skin.nodes.size();
  double largest = std::numeric_limits<double>::max();
  for (const auto &[p, q, r] : result.skin.triangles) {
    const Vector3 e = from_to(result.points[p], result.points[q]),
                  f = from_to(result.points[p], result.points[r]), normal = cross(e, f);
    const double square = dot(normal, normal);
    if (square == 0)
      continue;
    for (std::size_t first = 0; first < u.values.front().size(); first += n) {
      const Vector3 at = displacement_of(u, first + p),
                    d = from_to(at, displacement_of(u, first + q)),
                    g = from_to(at, displacement_of(u, first + r));
      const double b = dot(cross(e, g), normal) + dot(cross(d, f), normal),
                   c = dot(cross(d, g), normal);
      largest = std::min(largest, tenth_at(b / square, c / square));
    }
  }
  return largest;
}

/// The least eigenvalue of a symmetric matrix: xx, yy, zz, xy, yz, xz.
double least_principal(const std::array<double, 6> &m) {
  const auto &[xx, yy, zz, xy, yz, xz] = m;
  const double mean = (xx + yy + zz) / 3, a = xx - mean, b = yy - mean, c = zz - mean;
  const double p = std::sqrt((a * a + b * b + c * c + 2 * (xy * xy + yz * yz + xz * xz)) / 6);
  if (p == 0)
    return mean;
  const double half =
      (a * (b * c - yz * yz) - xy * (xy * c - yz * xz) + xz * (xy * yz - b * xz)) / (2 * p * p * p);
  return mean +
         2 * p * std::cos(std::acos(std::clamp(half, -1., 1.)) / 3 + 2 * std::numbers::pi / 3);
}

/// The largest magnification at which no cell of a solid body's skin is pressed to less than a
/// tenth in any direction, by its mean strain.
double unfolded_cells(const Field &strain) {
  static const std::array<const char *, 6> names{"xx", "yy", "zz", "xy", "yz", "xz"};
  std::array<const std::vector<float> *, 6> parts{};
  for (std::size_t k = 0; k < names.size(); ++k)
    for (std::size_t c = 0; c < strain.components.size(); ++c)
      if (strain.components[c] == names[k])
        parts[k] = &strain.values[c];
  double lowest = 0;
  for (std::size_t i = 0; i < strain.values.front().size(); ++i) {
    std::array<double, 6> m{};
    for (std::size_t k = 0; k < parts.size(); ++k)
      m[k] = parts[k] ? (*parts[k])[i] : 0;
    lowest = std::min(lowest, least_principal(m));
  }
  return lowest < 0 ? 0.9 / -lowest : std::numeric_limits<double>::max();
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
  const Field *u = result.field("displacement"), *strain = result.field("strain");
  const double largest = greatest_displacement(result);
  if (!(largest > 0))
    return 1;
  double wanted = std::min(0.1 * size_of(result) / largest, unfolded_triangles(result, *u));
  if (result.dimension == 3 && strain)
    wanted = std::min(wanted, unfolded_cells(*strain));
  const double power = std::pow(10, std::floor(std::log10(wanted)));
  for (const int digit : {8, 6, 5, 4, 3, 2})
    if (digit * power <= wanted * 1.000001)
      return digit * power;
  return power;
}

}  // namespace tourmaline::report
