#pragma once

#include <string>
#include <utility>
#include <vector>

namespace tourmaline::casefile {

/// Values over the time t, piecewise linear between points. Before the first and behind the last
/// point it has no value that anybody gave: a case whose time goes beyond is refused
/// (`check_tables`), and round-off of a time at an end gets that end's value.
class LoadTable {
 public:
  /// t [s] and a value, by ascending t.
  using Points = std::vector<std::pair<double, double>>;

  /// Throws CaseError, without a place, where there are no points, numbers that are not finite, or
  /// times that do not ascend.
  explicit LoadTable(Points points, std::string file = {});

  double value(double time) const;
  double begin() const { return points_.front().first; }
  double end() const { return points_.back().first; }
  const Points &points() const { return points_; }
  /// "the table in FILE", or "the table" where the points stand in the case.
  std::string called() const { return file_.empty() ? "the table" : "the table in " + file_; }
  /// { points = [[t, value], ...] }
  std::string text() const;

 private:
  Points points_;
  std::string file_;
};

}  // namespace tourmaline::casefile
