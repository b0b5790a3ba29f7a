#include "override.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <iterator>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "case/double_range.h"
#include "case/given_table.h"
#include "case/nearest.h"
#include "case/toml_text.h"
#include "case/utf8.h"
#include "tourmaline/error.h"
#include "value.h"

namespace tourmaline::casefile {

namespace {

struct Override {
  std::string place;  ///< the override itself, which begins every error text
  std::vector<std::string> path;
  std::vector<bool> in_brackets;  ///< by part of the path
  std::string value;
};

[[noreturn]] void fail(const Override &asked, const std::string &reason) {
  throw CaseError(asked.place + ": " + reason);
}

// Each "[" has its "]".
bool has_whole_brackets(std::string_view path) {
  bool inside = false;
  for (const char c : path)
    if (c == '[' || c == ']') {
      if (inside != (c == ']'))
        return false;
      inside = !inside;
    }
  return !inside;
}

// "boundary[1].potential" -> boundary, 1, potential; names in brackets may have points
void split_path(std::string_view text, Override &asked) {
  asked.path.assign(1, "");
  asked.in_brackets.assign(1, false);
  bool inside = false;
  for (const char c : text) {
    inside = c == '[' || (inside && c != ']');
    if (c == '[' || (c == '.' && !inside)) {
      asked.path.emplace_back();
      asked.in_brackets.push_back(c == '[');
    } else if (c != ']') {
      asked.path.back() += c;
    }
  }
}

std::string trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos)
    return "";
  return std::string(text.substr(first, text.find_last_not_of(" \t") - first + 1));
}

Override split(const std::string &assignment) {
  Override asked{.place = "--set " + shortened(readable(assignment)),
                 .path = {},
                 .in_brackets = {},
                 .value = {}};
  if (!is_utf8(assignment))
    fail(asked, "is not UTF-8");
  const auto equals = assignment.find('=');
  if (equals == std::string::npos)
    fail(asked, "has no \"=\"; write key.path=value");
  const std::string key = trimmed(std::string_view(assignment).substr(0, equals));
  if (!has_whole_brackets(key))
    fail(asked,
         "entries of lists are counted from 0, as in boundary[0].potential=5, or go by their name");
  split_path(key, asked);
  asked.value = trimmed(std::string_view(assignment).substr(equals + 1));
  if (std::find(asked.path.begin(), asked.path.end(), "") != asked.path.end())
    fail(asked, "the key's path has an empty part; write key.path=value");
  if (asked.value.empty())
    fail(asked, "has no value; write key.path=value");
  return asked;
}

// The value as TOML reads it, in a table of its own under the name "value", where it remembers its
// place. Nothing when it is not TOML.
std::optional<toml::table> parsed(const std::string &value, const std::string &place,
                                  std::string *reason = nullptr) {
  try {
    toml::table table = toml::parse("value = " + value, std::string_view(place));
    // A line break inside the value must not smuggle in further keys.
    if (table.size() == 1)
      return table;
    if (reason)
      *reason = "there are several";
  } catch (const toml::parse_error &error) {
    if (reason)
      *reason = toml_complaint(error);
  }
  return std::nullopt;
}

bool is_bare(const std::string &value) {
  return std::string_view("[{\"'").find(value.front()) == std::string_view::npos;
}

toml::table value_of(const Override &asked) {
  if (const auto small = too_small_in_toml(asked.value))
    fail(asked, small->reason);
  std::string reason;
  if (auto table = parsed(asked.value, asked.place, &reason))
    return std::move(*table);
  if (const std::string text = too_large_in_toml(asked.value); !text.empty())
    fail(asked, text);
  if (is_bare(asked.value) && asked.value.find('\n') == std::string::npos)
    if (auto table = parsed("'''" + asked.value + "'''", asked.place))
      return std::move(*table);
  fail(asked, "the value is not one of TOML's: " + reason);
}

// An empty table or array that remembers the override as its place.
toml::table empty(const Override &asked, bool array) {
  return *parsed(array ? "[]" : "{}", asked.place);
}

bool is_index(const std::string &part) {
  return part.size() < 6 && std::all_of(part.begin(), part.end(),
                                        [](unsigned char c) { return std::isdigit(c) != 0; });
}

std::string joined(const std::vector<std::string> &path, std::size_t parts) {
  std::string text;
  for (std::size_t i = 0; i < parts; ++i)
    text += (i == 0 ? "" : ".") + path[i];
  return text;
}

// What an entry is called: its name, or else what it is on, joined by "+".
std::string name_of(const toml::node &entry) {
  const toml::table *table = entry.as_table();
  if (!table)
    return "";
  if (const auto name = (*table)["name"].value<std::string>())
    return *name;
  if (const auto on = (*table)["on"].value<std::string>())
    return *on;
  std::string all;
  if (const toml::array *on = (*table)["on"].as_array())
    for (const toml::node &one : *on)
      all += (all.empty() ? "" : "+") + one.value_or(std::string());
  return all;
}

// A name in brackets becomes the number of its entry.
void count_name(const toml::node &parent, Override &asked, std::size_t part) {
  std::string &name = asked.path[part];
  if (!asked.in_brackets[part] || is_index(name))
    return;
  const std::string list = joined(asked.path, part);
  const toml::array *array = parent.as_array();
  if (!array)
    fail(asked,
         fmt::format("{0} is no list with an entry \"{1}\"; write {0}.KEY", list, shortened(name)));
  std::vector<std::string> names;
  for (const toml::node &entry : *array)
    if (std::string called = name_of(entry); !called.empty())
      names.push_back(std::move(called));
  if (std::count(names.begin(), names.end(), name) > 1)
    fail(asked, fmt::format("several entries of {0} are called \"{1}\"; give the number of one, as "
                            "{0}[0]",
                            list, shortened(name)));
  for (std::size_t i = 0; i < array->size(); ++i)
    if (name_of(*array->get(i)) == name) {
      name = std::to_string(i);
      return;
    }
  fail(asked,
       fmt::format(
           "no entry of {} is called \"{}\"{}{}", list, shortened(name), did_you_mean(name, names),
           names.empty() ? "" : "; there are " + fmt::format("{}", fmt::join(names, ", "))));
}

std::size_t index_in(const toml::array &array, const Override &asked, std::size_t part) {
  const std::string name = joined(asked.path, part);
  if (!is_index(asked.path[part]))
    fail(asked, fmt::format("{} is a list; its entries are {}[0], {}[1], ...", name, name, name));
  const auto index = static_cast<std::size_t>(std::stoi(asked.path[part]));
  if (index > array.size())
    fail(asked, fmt::format("{} has {} entries, counted from 0; {}[{}] would be the next one", name,
                            array.size(), name, array.size()));
  return index;
}

// The place for the part of that number inside `parent`: what is there, or nullptr.
toml::node *child(toml::node &parent, const Override &asked, std::size_t part) {
  if (toml::table *table = parent.as_table()) {
    if (part > 0 && is_index(asked.path[part]))
      fail(asked, fmt::format("{0} is a table and no list; write {0}.KEY without a number",
                              joined(asked.path, part)));
    return table->get(asked.path[part]);
  }
  if (toml::array *array = parent.as_array())
    return array->get(index_in(*array, asked, part));
  fail(asked, fmt::format("{} is a value, which has no key or entry \"{}\"",
                          joined(asked.path, part), asked.path[part]));
}

void put(toml::node &parent, const Override &asked, std::size_t part, toml::node &&value) {
  if (toml::table *table = parent.as_table()) {
    const toml::source_region place = value.source();
    table->erase(asked.path[part]);
    table->insert(toml::key(asked.path[part], place), std::move(value));
    return;
  }
  toml::array &array = *parent.as_array();
  const std::size_t index = index_in(array, asked, part);
  if (index < array.size())
    array.erase(array.begin() + static_cast<std::ptrdiff_t>(index));
  array.insert(array.begin() + static_cast<std::ptrdiff_t>(index), std::move(value));
}

// Of the parts before that one, without the numbers of entries, as the keys are declared.
std::string declared_path(const std::vector<std::string> &path, std::size_t parts) {
  std::vector<std::string> names;
  std::copy_if(path.begin(), path.begin() + static_cast<std::ptrdiff_t>(parts),
               std::back_inserter(names), [](const std::string &part) { return !is_index(part); });
  return joined(names, names.size());
}

// A value that stands for a key of a table becomes that table, so that others can be added. The
// table's place is the override, which asks for these.
void make_table_of_value(toml::node &parent, const Override &asked, std::size_t part) {
  toml::node &value = *child(parent, asked, part);
  if (value.is_table())
    return;
  const std::string sole = sole_key_of(declared_path(asked.path, part + 1));
  if (sole.empty())
    return;
  toml::table made = empty(asked, false);
  toml::table &around = *made.get_as<toml::table>("value");
  const toml::source_region place = value.source();
  around.insert(toml::key(sole, place), std::move(value));
  put(parent, asked, part, std::move(around));
}

}  // namespace

void apply_override(toml::table &root, const std::string &assignment) {
  Override asked = split(assignment);
  toml::table value = value_of(asked);
  toml::node *parent = &root;
  const std::size_t last = asked.path.size() - 1;
  for (std::size_t part = 0; part < last; ++part) {
    count_name(*parent, asked, part);
    if (!child(*parent, asked, part)) {
      toml::table made = empty(asked, is_index(asked.path[part + 1]));
      put(*parent, asked, part, std::move(*made.get("value")));
    }
    make_table_of_value(*parent, asked, part);
    parent = child(*parent, asked, part);
  }
  count_name(*parent, asked, last);
  child(*parent, asked, last);  // complains about a path that goes through a value
  put(*parent, asked, last, std::move(*value.get("value")));
}

}  // namespace tourmaline::casefile
