#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace tourmaline::casefile {

/// One [[probe]] entry: the fields at a point, or at equidistant points of a line, in every step.
struct ProbeCase {
  std::string name;  ///< letters, digits, _ and -
  std::string where;
  std::map<std::string, std::string> places;    ///< of its keys: file, line and key
  std::optional<std::vector<double>> at;        ///< [m], one entry for each axis
  std::optional<std::vector<double>> from, to;  ///< ends of a line [m]
  int points = 21;                              ///< of the line, its ends among them

  bool is_line() const { return from.has_value(); }
};

}  // namespace tourmaline::casefile
