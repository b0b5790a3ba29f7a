#include "case/table_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

#include "case/nearest.h"
#include "case/toml_text.h"
#include "case/utf8.h"
#include "tourmaline/error.h"
#include "whole_file.h"

namespace tourmaline::casefile {

namespace {

using Fields = std::vector<std::string>;

std::string trimmed(const std::string &text) {
  constexpr const char *blank = " \t\r";
  const std::size_t begin = text.find_first_not_of(blank);
  if (begin == std::string::npos)
    return "";
  std::string inner = text.substr(begin, text.find_last_not_of(blank) - begin + 1);
  if (inner.size() > 1 && inner.front() == '"' && inner.back() == '"')
    inner = inner.substr(1, inner.size() - 2);
  return inner;
}

char separator_of(const std::string &line) {
  for (const char separator : {';', '\t', ','})
    if (line.find(separator) != std::string::npos)
      return separator;
  return ',';
}

Fields fields_of(const std::string &line, char separator) {
  Fields fields;
  std::istringstream in(line);
  for (std::string field; std::getline(in, field, separator);)
    fields.push_back(trimmed(field));
  return fields;
}

std::optional<double> number_of_field(const std::string &text) {
  const std::string digits = text.starts_with('+') ? text.substr(1) : text;
  double number = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (digits.empty() || error != std::errc() || end != digits.data() + digits.size())
    return std::nullopt;
  return number;
}

std::string names_listed(const Fields &names) {
  std::string all;
  for (const std::string &name : names)
    all += (all.empty() ? "" : ", ") + toml_text(name);
  return all;
}

/// Reads one file line by line.
class TableReader {
 public:
  TableReader(const std::string &file, const std::optional<std::string> &column)
      : file_(file), column_(column) {}

  LoadTable::Points read(const std::string &text) {
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) {
      ++line_;
      if (line_ == 1 && line.starts_with("\xEF\xBB\xBF"))  // byte order mark
        line.erase(0, 3);
      const std::string inner = trimmed(line);
      if (!inner.empty() && inner.front() != '#')
        add(line);
    }
    if (points_.empty())
      throw CaseError(file_ + ": has no row of numbers; its columns are t and values over t");
    return std::move(points_);
  }

 private:
  [[noreturn]] void fail(const std::string &reason) const {
    throw CaseError(fmt::format("{}:{}: {}", file_, line_, reason));
  }

  void add(const std::string &line) {
    if (is_first_) {
      is_first_ = false;
      separator_ = separator_of(line);
      const Fields fields = fields_of(line, separator_);
      const bool has_names = !number_of_field(fields.front());
      columns_ = fields.size();
      choose(fields, has_names);
      if (has_names)
        return;
    }
    const Fields fields = fields_of(line, separator_);
    if (fields.size() != columns_)
      fail(
          fmt::format("has {} columns, and the first line of the table has {}; numbers are written "
                      "with a point, columns stand apart by one of , ; and tabulators",
                      fields.size(), columns_));
    add_point(fields);
  }

  void choose(const Fields &names, bool has_names) {
    if (names.size() < 2)
      fail("has one column; the first is t, and another one has the values");
    if (!column_)
      return;
    if (!has_names)
      fail(
          fmt::format("begins with numbers, so that no column has a name; give the columns names "
                      "in the first line, or leave out column = {}",
                      toml_text(*column_)));
    const auto found = std::find(names.begin() + 1, names.end(), *column_);
    const Fields others(names.begin() + 1, names.end());
    if (found == names.end())
      fail(fmt::format("has no column {}; there are {} over {}{}", toml_text(*column_),
                       names_listed(others), toml_text(names.front()),
                       did_you_mean(*column_, others)));
    if (std::count(names.begin() + 1, names.end(), *column_) > 1)
      fail(fmt::format("has several columns {}; give each a name of its own", toml_text(*column_)));
    at_ = static_cast<std::size_t>(found - names.begin());
  }

  double number(const Fields &fields, std::size_t i) const {
    const auto found = number_of_field(fields[i]);
    if (fields[i].empty())
      fail(fmt::format("column {} is empty", i + 1));
    if (!found)
      fail(fmt::format("column {} is {}, which is no number{}", i + 1,
                       toml_text(shortened(fields[i])), way_out(fields[i])));
    if (!std::isfinite(*found))
      fail(fmt::format("column {} is {}, which is not a finite number", i + 1, fields[i]));
    return *found;
  }

  // What a spreadsheet's table lacks most often.
  std::string way_out(std::string text) const {
    std::replace(text.begin(), text.end(), ',', '.');
    if (number_of_field(text))
      return "; decimals stand behind a point";
    return points_.empty() ? "; lines that begin with # are left out" : "";
  }

  void add_point(const Fields &fields) {
    const double t = number(fields, 0);
    if (!points_.empty() && !(t > points_.back().first))
      fail(
          fmt::format("t = {} s follows t = {} s; times must ascend: a value that jumps takes two "
                      "times that lie close together",
                      t, points_.back().first));
    points_.emplace_back(t, number(fields, at_));
  }

  std::string file_;
  std::optional<std::string> column_;
  LoadTable::Points points_;
  bool is_first_ = true;
  char separator_ = ',';
  std::size_t line_ = 0, at_ = 1, columns_ = 0;
};

}  // namespace

LoadTable::Points points_in_text(const std::string &text, const std::string &file,
                                 const std::optional<std::string> &column) {
  require_utf8(text, file);
  if (text.find_first_not_of(" \t\r\n") == std::string::npos)
    throw CaseError(file + ": is empty; its columns are t and values over t");
  return TableReader(file, column).read(text);
}

LoadTable::Points points_in_file(const std::filesystem::path &file,
                                 const std::optional<std::string> &column) {
  std::error_code ignored;
  const std::string name = file.string();
  if (!std::filesystem::exists(file, ignored))
    throw CaseError(name + ": there is no such file");
  if (!std::filesystem::is_regular_file(file, ignored))
    throw CaseError(name + ": is no file of values");
  constexpr std::uintmax_t most = 64 << 20;
  if (std::filesystem::file_size(file, ignored) > most)
    throw CaseError(name + ": is larger than 64 MiB");
  const std::optional<std::string> text = whole_file(file);
  if (!text)
    throw CaseError(name + ": cannot be read");
  return points_in_text(*text, name, column);
}

}  // namespace tourmaline::casefile
