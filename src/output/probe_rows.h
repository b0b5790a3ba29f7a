#pragma once

#include <string>
#include <vector>

namespace tourmaline::output {

/// What one probe tells of a step: rows of numbers, one for each column. Every step of a run has
/// the same columns.
struct ProbeRows {
  std::string name;  ///< of its table probe-NAME.csv
  std::vector<std::string> columns;
  std::vector<std::vector<double>> rows;
};

/// "probe-NAME.csv"
inline std::string probe_file(const std::string &name) {
  return "probe-" + name + ".csv";
}

}  // namespace tourmaline::output
