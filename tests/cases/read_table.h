#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace tourmaline::verified {

/// A CSV file by columns, cells as text.
struct Table {
  std::map<std::string, std::vector<std::string>> columns;

  std::size_t n_rows() const { return columns.begin()->second.size(); }
  std::vector<double> numbers(const std::string &column) const {
    std::vector<double> values;
    for (const std::string &cell : columns.at(column))
      values.push_back(std::strtod(cell.c_str(), nullptr));  // stod throws for 1e-310
    return values;
  }
};

inline std::vector<std::string> split(const std::string &line) {
  std::vector<std::string> cells;
  std::stringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');)
    cells.push_back(cell);
  return cells;
}

inline Table read_table(const std::filesystem::path &file) {
  std::ifstream in(file);
  EXPECT_TRUE(in) << file;
  std::string line;
  std::getline(in, line);
  const std::vector<std::string> names = split(line);
  Table table;
  while (std::getline(in, line)) {
    const std::vector<std::string> cells = split(line);
    for (std::size_t i = 0; i < names.size(); ++i)
      table.columns[names[i]].push_back(cells.at(i));
  }
  return table;
}

inline double largest(const std::vector<double> &values) {
  double size = 0;
  for (const double v : values)
    size = std::max(size, std::abs(v));
  return size;
}

inline double largest(const Table &table, const std::string &column) {
  return largest(table.numbers(column));
}

/// Largest difference of a column over `size`, or over the second table's largest value.
inline double difference(const Table &ours, const Table &theirs, const std::string &column,
                         double size = 0) {
  const std::vector<double> a = ours.numbers(column), b = theirs.numbers(column);
  EXPECT_EQ(a.size(), b.size()) << column;
  double worst = 0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    EXPECT_FALSE(std::isnan(a[i] - b[i])) << column;  // which std::max would pass over
    worst = std::max(worst, std::abs(a[i] - b[i]));
  }
  const double scale = size > 0 ? size : largest(b);
  return scale > 0 ? worst / scale : worst;
}

}  // namespace tourmaline::verified
