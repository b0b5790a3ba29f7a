#include "report/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <optional>
#include <string_view>

#include "output/records.h"
#include "report/text_file.h"
#include "tourmaline/error.h"

namespace tourmaline::report {
namespace {

std::vector<std::string_view> split(std::string_view line) {
  std::vector<std::string_view> cells;
  while (true) {
    const std::size_t comma = line.find(',');
    cells.push_back(line.substr(0, comma));
    if (comma == std::string_view::npos)
      return cells;
    line.remove_prefix(comma + 1);
  }
}

/// Of a word or a number, NaN for an empty cell; nothing for what is neither.
std::optional<double> value_of(std::string_view cell) {
  if (cell.empty())
    return std::numeric_limits<double>::quiet_NaN();
  for (const auto status : {ContactStatus::open, ContactStatus::stick, ContactStatus::slip})
    if (cell == name_of(status))
      return static_cast<double>(status);
  double value = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  const bool is_number = error == std::errc() && end == cell.data() + cell.size();
  return is_number ? std::optional(value) : std::nullopt;
}

}  // namespace

const std::vector<double> *Table::find(const std::string &name) const {
  const auto found = std::find(names.begin(), names.end(), name);
  return found == names.end() ? nullptr : &columns[found - names.begin()];
}

namespace {

std::optional<double> place_in(const std::vector<std::string> &words, std::string_view cell) {
  const auto found = std::find(words.begin(), words.end(), cell);
  return found == words.end() ? std::nullopt
                              : std::optional(static_cast<double>(found - words.begin()));
}

}  // namespace

Table read_table(const std::filesystem::path &path, const std::string &column_of_words,
                 const std::vector<std::string> &words) {
  const std::string text = read_text_file(path);
  Table table;
  std::size_t number = 0;
  for (std::string_view rest = text; !rest.empty();) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    const std::vector<std::string_view> cells = split(rest.substr(0, end));
    rest.remove_prefix(std::min(end + 1, rest.size()));
    if (++number == 1) {
      table.names.assign(cells.begin(), cells.end());
      table.columns.resize(cells.size());
      continue;
    }
    if (cells.size() != table.names.size())
      throw CaseError(fmt::format("{}:{}: {} columns where the header has {}", path.string(),
                                  number, cells.size(), table.names.size()));
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const auto value = table.names[i] == column_of_words && !words.empty()
                             ? place_in(words, cells[i])
                             : value_of(cells[i]);
      if (!value && table.names[i] != column_of_words)
        throw CaseError(fmt::format("{}:{}: \"{}\" in column {} is no number", path.string(),
                                    number, cells[i], table.names[i]));
      table.columns[i].push_back(value.value_or(std::numeric_limits<double>::quiet_NaN()));
    }
  }
  return table;
}

}  // namespace tourmaline::report
