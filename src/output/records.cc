#include "output/records.h"

#include <algorithm>

namespace tourmaline::output {

std::vector<std::uint32_t> keep_used_points(Grid &grid) {
  std::vector<std::uint32_t> used(grid.connectivity);
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  std::vector<Vector3> points;
  std::vector<std::uint32_t> number(grid.points.size());
  for (const std::uint32_t point : used) {
    number[point] = static_cast<std::uint32_t>(points.size());
    points.push_back(grid.points[point]);
  }
  for (std::uint32_t &point : grid.connectivity)
    point = number[point];
  grid.points = std::move(points);
  return used;
}

const double *HistoryRow::find(std::string_view name) const {
  const auto found = std::find_if(quantities.begin(), quantities.end(),
                                  [&](const auto &quantity) { return quantity.first == name; });
  return found == quantities.end() ? nullptr : &found->second;
}

}  // namespace tourmaline::output
