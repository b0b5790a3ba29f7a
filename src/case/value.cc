#include "value.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "case/double_range.h"
#include "case/load_table.h"
#include "case/nearest.h"
#include "case/table_file.h"
#include "case/toml_text.h"
#include "case/units.h"
#include "tourmaline/error.h"

namespace tourmaline::casefile {

std::string place_of(const toml::source_region &source) {
  std::string path = source.path ? *source.path : "";
  if (path.starts_with("--set"))
    return path;
  return fmt::format("{}:{}:{}", path, source.begin.line, source.begin.column);
}

namespace {

std::string quoted_whole(const toml::node &node);

std::string quoted_entries(const toml::node &node) {
  std::string text;
  if (const toml::array *array = node.as_array())
    for (const toml::node &entry : *array)
      text += (text.empty() ? "" : ", ") + quoted_whole(entry);
  if (const toml::table *table = node.as_table())
    for (const auto &[name, entry] : *table)
      text += (text.empty() ? "" : ", ") + std::string(name.str()) + " = " + quoted_whole(entry);
  return text;
}

std::string quoted_whole(const toml::node &node) {
  if (node.is_array())
    return "[" + quoted_entries(node) + "]";
  if (node.is_table())
    return "{ " + quoted_entries(node) + " }";
  if (const auto text = node.value_exact<std::string>())
    return toml_text(*text);
  if (const auto number = node.value_exact<double>())
    return fmt::format("{}", *number);
  std::ostringstream out;
  node.visit([&](const auto &value) { out << value; });
  return out.str();
}

std::string type_of(const toml::node &node) {
  switch (node.type()) {
    case toml::node_type::string:
      return "a text";
    case toml::node_type::integer:
      return "an integer";
    case toml::node_type::floating_point:
      return "a number";
    case toml::node_type::boolean:
      return "true or false";
    case toml::node_type::array:
      return "a list";
    case toml::node_type::table:
      return "a table";
    default:
      return "a date or time";
  }
}

[[noreturn]] void fail_type(const Item &item, const std::string &wanted) {
  fail(item, fmt::format("is {}, but must be {}{}", type_of(item.node), wanted,
                         item.otherwise.empty() ? "" : ", or " + item.otherwise));
}

void check_range(const Item &item, double number) {
  if (const std::string wrong = complaint(item.key.range, number, item.key.unit); !wrong.empty())
    fail(item, wrong);
  if (number != 0 && !std::isnormal(number))
    fail(item, "is closer to 0 than double precision holds; write 0");
}

std::string quoted_list(const std::vector<std::string> &texts) {
  std::string all;
  for (const std::string &text : texts)
    all += (all.empty() ? "\"" : ", \"") + text + "\"";
  return all;
}

void check_choice(const Item &item, const std::string &text) {
  const Key &key = item.key;
  const bool any = key.choices.empty() && key.no_choices.empty();
  if (any || std::find(key.choices.begin(), key.choices.end(), text) != key.choices.end())
    return;
  if (key.choices.empty())
    fail(item, "is not allowed; " + key.no_choices);
  for (const auto &[other, choice] : key.choices_also)
    if (edit_distance(other, text) == 0)
      fail(item, "is not allowed; allowed: " + quoted_list(key.choices) + "; did you mean \"" +
                     choice + "\"?");
  fail(item,
       "is not allowed; allowed: " + quoted_list(key.choices) + did_you_mean(text, key.choices));
}

const toml::array &entries_of(const Item &item, std::string_view wanted) {
  if (const toml::array *array = item.node.as_array())
    return *array;
  fail_type(item, std::string(wanted));
}

std::string needed(const std::vector<int> &counts) {
  std::string text;
  for (const int count : counts)
    text += (text.empty() ? "" : " or ") + std::to_string(count);
  return text;
}

void check_length(const Item &item, std::size_t given) {
  const Length &length = item.key.length;
  if (length.counts.empty() || std::find(length.counts.begin(), length.counts.end(),
                                         static_cast<int>(given)) != length.counts.end())
    return;
  fail(item, fmt::format("has {} entr{}, but needs {}: {}{}", given, given == 1 ? "y" : "ies",
                         needed(length.counts), length.words,
                         length.reason.empty() ? "" : "; " + length.reason));
}

Item entry_of(const Item &item, const toml::array &entries, std::size_t i) {
  return {entries[i], item.key, fmt::format("{}[{}]", item.name, i), "", item.folder};
}

void read_into(const Item &item, bool &value) {
  const auto given = item.node.value_exact<bool>();
  if (!given)
    fail_type(item, "true or false");
  value = *given;
}

void read_into(const Item &item, int &value) {
  const auto given = item.node.value_exact<std::int64_t>();
  if (!given)
    fail_type(item, "an integer");
  check_range(item, static_cast<double>(*given));
  if (*given > std::numeric_limits<int>::max() || *given < std::numeric_limits<int>::min())
    fail(item, fmt::format("must be at most {}", std::numeric_limits<int>::max()));
  value = static_cast<int>(*given);
}

// "2 t" may be a product with the time that has no sign.
std::string hint_at_product(const std::string &unit) {
  const FormulaNames &names = formula_names();
  const std::string word = unit.substr(0, unit.find_first_of("*/+- ("));
  for (const auto *known : {&names.variables, &names.functions, &names.constants})
    if (std::find(known->begin(), known->end(), word) != known->end())
      return "; in a formula * stands before " + word;
  return "";
}

// Nothing where the value is no text of a number and a unit.
std::optional<double> number_with_unit(const Item &item) {
  const auto text = item.node.value_exact<std::string>();
  const std::optional<Quantity> quantity = text ? quantity_in(*text) : std::nullopt;
  if (!quantity)
    return std::nullopt;
  const Key &key = item.key;
  const Converted number = converted(*quantity, key.actual_unit(), key.is_absolute_temperature);
  if (!number.complaint.empty())
    fail(item, number.complaint + hint_at_product(quantity->unit));
  return number.value;
}

double number_in(const Item &item, const std::string &wanted) {
  if (const auto integer = item.node.value_exact<std::int64_t>())
    return static_cast<double>(*integer);
  if (const auto number = item.node.value_exact<double>())
    return *number;
  if (const auto number = number_with_unit(item))
    return *number;
  const std::string &unit = item.key.unit;
  fail_type(item, wanted + (unit.empty() ? "" : " [" + unit + "]"));
}

void read_into(const Item &item, double &value) {
  value = number_in(item, "a number");
  check_range(item, value);
}

void read_into(const Item &item, std::string &value) {
  const auto given = item.node.value_exact<std::string>();
  if (!given)
    fail_type(item, item.key.choices.empty() ? "a text"
                                             : "a text, one of " + quoted_list(item.key.choices));
  if (given->find('\0') != std::string::npos)
    fail(item, "has the character \\u0000, which no text can hold");
  check_choice(item, *given);
  value = *given;
}

void check_formula(const Item &item, const Formula &formula) {
  if (formula.is_number())
    check_range(item, formula.value({}, 0));
  if (item.key.constant_in_time && formula.depends_on_time())
    fail(item, "must not depend on the time t");
}

constexpr const char *forms_of_table =
    "a table of values over t is { table = \"FILE\", column = \"NAME\" } or { points = [[t, "
    "value], "
    "...] }";

void check_keys_of_table(const Item &item, const toml::table &given) {
  const std::vector<std::string> names{"table", "column", "points"};
  for (const auto &[key, node] : given)
    if (const std::string name(key.str());
        std::find(names.begin(), names.end(), name) == names.end())
      fail(item, fmt::format("has the unknown key {}; {}{}", toml_text(shortened(name)),
                             forms_of_table, did_you_mean(name, names)));
  if (given.contains("table") == given.contains("points"))
    fail(item, fmt::format("gives {} of `table` and `points`; {}",
                           given.contains("table") ? "both" : "none", forms_of_table));
  if (given.contains("points") && given.contains("column"))
    fail(item, std::string("`column` is of a file's table; ") + forms_of_table);
}

std::optional<std::string> text_in_table(const Item &item, const toml::table &given,
                                         const char *name) {
  const toml::node *node = given.get(name);
  if (!node)
    return std::nullopt;
  if (const auto text = node->value_exact<std::string>(); text && !text->empty())
    return *text;
  fail(item, fmt::format("`{}` is {}, but must be a text; {}", name,
                         node->is_string() ? "empty" : type_of(*node), forms_of_table));
}

LoadTable::Points points_given(const Item &item, const toml::node &points) {
  const toml::array *rows = points.as_array();
  if (!rows)
    fail(item,
         fmt::format("`points` is {}, but must be a list; {}", type_of(points), forms_of_table));
  const Key time{.name = "t", .description = "time", .unit = "s"};
  LoadTable::Points all;
  for (std::size_t i = 0; i < rows->size(); ++i) {
    const toml::array *row = rows->get(i)->as_array();
    const auto number = [&](std::size_t k, const Key &key) {
      return number_in({*row->get(k), key, fmt::format("{} points[{}]", item.name, i)}, "a number");
    };
    if (!row || row->size() != 2)
      fail(item, fmt::format("points[{}] is {}, but must be [t, value]", i, quoted(*rows->get(i))));
    all.emplace_back(number(0, time), number(1, item.key));
  }
  return all;
}

// Relative to the case, a mistake in the file with its place there.
LoadTable::Points points_of(const Item &item, const toml::table &given) {
  check_keys_of_table(item, given);
  if (const toml::node *points = given.get("points"))
    return points_given(item, *points);
  const std::string file = *text_in_table(item, given, "table");
  return points_in_file(item.folder / file, text_in_table(item, given, "column"));
}

Formula table_in(const Item &item, const toml::table &given) {
  std::shared_ptr<const LoadTable> table;
  const auto file = given["table"].value<std::string>();
  try {
    table = std::make_shared<const LoadTable>(points_of(item, given),
                                              file ? (item.folder / *file).string() : "");
  } catch (const CaseError &error) {
    if (std::string(error.what()).starts_with(place_of(item.node.source())))
      throw;
    fail(item, error.what());
  }
  for (const auto &[t, value] : table->points())
    if (const std::string wrong = complaint(item.key.range, value, item.key.unit); !wrong.empty())
      fail(item, fmt::format("{}has {} at t = {} s: {}", file ? table->called() + " " : "", value,
                             t, wrong));
  return Formula(table, item.where());
}

void read_into(const Item &item, Formula &value) {
  if (const toml::table *given = item.node.as_table())
    value = table_in(item, *given);
  else if (const auto with_unit = number_with_unit(item))
    value = Formula(*with_unit, item.where());
  else if (const auto text = item.node.value_exact<std::string>())
    value = Formula(*text, item.where(), item.key.range, item.key.unit);
  else if (const double number =
               number_in(item, "a number or a formula, or a table of values over t");
           std::isfinite(number))
    value = Formula(number, item.where());
  else
    fail(item, "is not a finite number");
  check_formula(item, value);
}

void read_into(const Item &item, std::optional<Formula> &component) {
  component.reset();
  const auto text = item.node.value_exact<std::string>();
  if (text == "free")
    return;
  if (text && nearest(*text, {"free"}))
    fail(item, "not a formula" + did_you_mean(*text, {"free"}));
  component.emplace();
  read_into(item, *component);
}

template <class T>
void read_entries(const Item &item, const std::string &wanted, std::vector<T> &values) {
  const toml::array &entries = entries_of(item, wanted);
  check_length(item, entries.size());
  values.assign(entries.size(), T());
  for (std::size_t i = 0; i < entries.size(); ++i)
    read_into(entry_of(item, entries, i), values[i]);
}

void read_into(const Item &item, std::vector<int> &values) {
  read_entries(item, "a list of integers", values);
}

void read_into(const Item &item, std::vector<double> &values) {
  read_entries(item, "a list of numbers", values);
}

void read_into(const Item &item, Matrix &rows) {
  const toml::array &entries = entries_of(item, "a list of rows");
  if (static_cast<int>(entries.size()) != item.key.rows)
    fail(item, fmt::format("has {} rows, but needs {}", entries.size(), item.key.rows));
  rows.assign(entries.size(), {});
  for (std::size_t i = 0; i < entries.size(); ++i)
    read_into(entry_of(item, entries, i), rows[i]);
}

void read_into(const Item &item, FormulaVector &values) {
  read_entries(item, "a list of numbers or formulas", values);
}

void read_into(const Item &item, Displacement &values) {
  read_entries(item, "a list of numbers, formulas or \"free\"", values);
}

void read_into(const Item &item, std::vector<std::string> &names) {
  if (item.node.is_string()) {
    names.assign(1, "");
    return read_into(item, names.front());
  }
  read_entries(item, "a text or a list of texts", names);
  if (names.empty())
    fail(item, "names nothing; " + (!item.key.choices.empty()
                                        ? "allowed: " + quoted_list(item.key.choices)
                                    : !item.key.no_choices.empty() ? item.key.no_choices
                                                                   : "give at least one name"));
  for (std::size_t i = 0; i < names.size(); ++i)
    if (std::find(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(i), names[i]) !=
        names.begin() + static_cast<std::ptrdiff_t>(i))
      fail(item, "names \"" + names[i] + "\" twice");
}

}  // namespace

std::string toml_complaint(const toml::parse_error &error) {
  std::string text(error.description());
  // It says of 1e400 only that it "could not be interpreted as a value".
  if (text.find("unescaped control characters") != std::string::npos)
    return text + "; where that is the end of the line, a closing quote is missing";
  const std::size_t begin = text.find('\'');
  const std::string reason =
      begin == std::string::npos ? "" : too_large_in_toml(text.substr(begin + 1));
  return text + (reason.empty() ? "" : "; " + reason);
}

std::string quoted(const toml::node &node) {
  return shortened(quoted_whole(node));
}

void fail(const Item &item, const std::string &reason) {
  throw CaseError(item.where() + " = " + quoted(item.node) + ": " + reason);
}

void read(const Item &item, Value value) {
  std::visit([&](auto *target) { read_into(item, *target); }, value);
}

}  // namespace tourmaline::casefile
