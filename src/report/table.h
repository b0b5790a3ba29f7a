#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tourmaline::report {

/// A table of a run (history.csv, contact.csv), by columns. Contact states are numbers in the order
/// of ContactStatus: open 0, stick 1, slip 2.
struct Table {
  std::vector<std::string> names;
  std::vector<std::vector<double>> columns;

  std::size_t n_rows() const { return columns.empty() ? 0 : columns.front().size(); }
  /// Null when there is no such column.
  const std::vector<double> *find(const std::string &name) const;
};

/// Throws CaseError when the file cannot be read or a line does not have the header's columns.
/// In the column of that name the words stand for their places in the list.
Table read_table(const std::filesystem::path &path, const std::string &column_of_words = "",
                 const std::vector<std::string> &words = {});

}  // namespace tourmaline::report
