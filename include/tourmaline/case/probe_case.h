#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace tourmaline::casefile {

/// One [[probe]] entry: a place, a line, boundaries or a region, of which a table tells in every
/// step. Exactly one of `at`, `from` with `to` and `points`, `on` and `region` is given.
struct ProbeCase {
  std::string name;                                ///< of its table, probe-NAME.csv
  std::string where;                               ///< file and line of the entry
  std::map<std::string, std::string> places;       ///< of its keys: file, line and key
  std::optional<std::vector<double>> at;           ///< [m]
  std::optional<std::vector<double>> from, to;     ///< ends of the line [m]
  std::optional<int> points;                       ///< on the line, its ends among them
  std::optional<std::vector<std::string>> on;      ///< boundaries
  std::vector<double> about;                       ///< of the moment [m]; empty: the origin
  std::optional<std::vector<std::string>> region;  ///< names of [[region]] entries
};

}  // namespace tourmaline::casefile
