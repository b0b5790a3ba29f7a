#include "case/load_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tourmaline/error.h"

namespace tourmaline::casefile {

LoadTable::LoadTable(Points points, std::string file)
    : points_(std::move(points)), file_(std::move(file)) {
  if (points_.empty())
    throw CaseError("has no points");
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const auto &[t, value] = points_[i];
    if (!std::isfinite(t) || !std::isfinite(value))
      throw CaseError(fmt::format("has ({}, {}), which are not finite numbers", t, value));
    if (i > 0 && !(t > points_[i - 1].first))
      throw CaseError(fmt::format(
          "has t = {} s after t = {} s; times must ascend: a value that jumps takes two times that "
          "lie close together",
          t, points_[i - 1].first));
  }
}

double LoadTable::value(double time) const {
  const auto later = std::upper_bound(points_.begin(), points_.end(), time,
                                      [](double t, const auto &point) { return t < point.first; });
  if (later == points_.begin())
    return later->second;
  const auto &[t0, v0] = *(later - 1);
  if (later == points_.end() || time == t0)
    return v0;
  const auto &[t1, v1] = *later;
  const double along = (time - t0) / (t1 - t0);
  return (1 - along) * v0 + along * v1;
}

std::string LoadTable::text() const {
  std::string list;
  for (const auto &[t, value] : points_)
    list += fmt::format("{}[{}, {}]", list.empty() ? "" : ", ", t, value);
  return "{ points = [" + list + "] }";
}

}  // namespace tourmaline::casefile
