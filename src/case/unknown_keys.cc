#include "case/unknown_keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "case/given_table.h"
#include "case/nearest.h"
#include "case/schema.h"
#include "case/toml_text.h"
#include "tourmaline/case/case.h"
#include "tourmaline/error.h"
#include "value.h"

namespace tourmaline::casefile {

void Names::add(const Key &key) {
  all.push_back(key.name);
  for (const std::string &other : key.also)
    also.emplace_back(other, key.name);
}

void Names::key(const Key &key, Value value) {
  add(key);
  if (std::holds_alternative<std::string *>(value) && !key.choices.empty())
    laws.push_back(key);
}

bool Names::given(const Key &key, bool) {
  add(key);
  return false;
}

void Names::table(const Key &key, const Body &) {
  add(key);
}

int Names::count(const Key &key, int) {
  all.push_back(key.name);
  return 0;
}

void Names::refuse(const std::string &name, const std::string &reason) {
  refused.emplace_back(name, reason);
}

bool Names::hold(const std::string &name) const {
  return std::find(all.begin(), all.end(), name) != all.end();
}

namespace {

/// The tables, by their paths, that have a key of a certain name.
class TablesWith : public Visitor {
 public:
  explicit TablesWith(std::string name) : name_(std::move(name)) {}

  std::vector<std::string> found;
  bool is_of_top = false;  ///< a table of the file itself

  void key(const Key &key, Value) override {
    if (key.name == name_)
      found.push_back(path_);
  }
  bool given(const Key &, bool) override { return true; }
  void table(const Key &key, const Body &body) override {
    const std::string outside = path_;
    if (!key.sole.empty() && key.name == name_)
      found.push_back(path_);
    is_of_top = is_of_top || (path_.empty() && key.name == name_);
    path_ += (path_.empty() ? "" : ".") + key.name;
    body(*this);
    path_ = outside;
  }
  int count(const Key &, int) override { return 1; }
  void entry(const Key &key, int, const Body &body) override { table(key, body); }

 private:
  std::string name_, path_;
};

// A key that has strayed into another table; `nearest`: what else may be meant.
std::string found_elsewhere(const std::string &name, const std::string &nearest) {
  Case scratch;
  TablesWith tables(name);
  declare(tables, scratch);
  if (tables.is_of_top)
    return fmt::format(
        "; {0} is a table of its own: write {0} = ... before the first [table], or [{0}]", name);
  if (!nearest.empty())
    return nearest;
  const std::string words = fmt::format("{}", fmt::join(tables.found, "], ["));
  return words.empty() ? "" : fmt::format("; there is one of that name in [{}]", words);
}

struct Unknown {
  std::string path;  ///< of the table that holds it, with dots
  toml::key key;
  const toml::node *node;
  std::vector<std::string> allowed;
  std::string reason;  ///< of a name that one may expect there
  std::string meant;   ///< the key whose symbol or other name this is

  // Those of the command line stand behind those of the file.
  auto order() const {
    const toml::source_region &source = key.source();
    return std::tuple(place_of(source).starts_with("--set"), source.begin.line,
                      source.begin.column);
  }

  std::string text() const {
    const std::string name(key.str());
    const std::string place =
        fmt::format("{}{} {} = {}", place_of(key.source()), path.empty() ? "" : " [" + path + "]",
                    shortened(name), quoted(*node));
    if (!reason.empty())
      return place + ": " + reason;
    constexpr std::size_t most = 12;
    std::string list;
    if (allowed.size() <= most)
      list = fmt::format("; allowed: {}", fmt::join(allowed, ", "));
    const std::string near =
        meant.empty() ? did_you_mean(name, allowed) : "; did you mean \"" + meant + "\"?";
    return place + ": unknown key" + list + found_elsewhere(name, near);
  }
};

/// Looks through one table and those inside it, and reads what decides which keys there are.
class Census : public Visitor {
 public:
  Census(const GivenTable &table, std::string path, std::vector<Unknown> &found)
      : table_(table), path_(std::move(path)), found_(found) {}

  void look(const Body &body) {
    Names names;
    body(names);
    if (!std::all_of(names.laws.begin(), names.laws.end(),
                     [&](const Key &law) { return exists(law); }))
      return;
    if (const toml::table *keys = table_.keys())
      for (const auto &[key, node] : *keys)
        if (!names.hold(std::string(key.str())))
          found_.push_back({path_, key, &node, names.all, reason(names, std::string(key.str())),
                            meant(names, std::string(key.str()))});
    body(*this);
  }

  void key(const Key &key, Value value) override {
    if (key.used.holds)
      read_if_right(key, value);
  }
  bool given(const Key &key, bool) override { return table_.get(key.name) != nullptr; }
  void table(const Key &key, const Body &body) override {
    if (const toml::node *node = table_.get(key.name))
      if (const std::optional<GivenTable> inner = given_table(*node, key))
        Census(*inner, path_to(key.name), found_).look(body);
  }
  int count(const Key &key, int) override {
    const toml::node *node = table_.get(key.name);
    if (key.may_be_table && node && node->is_table())
      return 1;
    return node && node->is_array_of_tables() ? static_cast<int>(node->as_array()->size()) : 0;
  }
  void entry(const Key &key, int index, const Body &body) override {
    if (const toml::table *alone = table_.get(key.name)->as_table()) {
      Census(GivenTable(*alone), path_to(key.name), found_).look(body);
      return;
    }
    const auto i = static_cast<std::size_t>(index);
    Census(GivenTable(*table_.get(key.name)->as_array()->get_as<toml::table>(i)),
           fmt::format("{}[{}]", path_to(key.name), index), found_)
        .look(body);
  }

 private:
  std::string path_to(const std::string &name) const {
    return path_.empty() ? name : path_ + "." + name;
  }

  bool read_if_right(const Key &key, Value value) const {
    const toml::node *node = table_.get(key.name);
    try {
      if (node)
        read({*node, key, ""}, value);
    } catch (const CaseError &) {
      return false;
    }
    return true;
  }

  bool exists(const Key &law) const {
    std::string ignored;
    return read_if_right(law, &ignored);
  }

  static std::string reason(const Names &names, const std::string &name) {
    for (const auto &[refused, reason] : names.refused)
      if (name == refused)
        return reason;
    return "";
  }

  static std::string meant(const Names &names, const std::string &name) {
    for (const auto &[other, key] : names.also)
      if (edit_distance(other, name) == 0)
        return key;
    return "";
  }

  GivenTable table_;
  std::string path_;  // with dots
  std::vector<Unknown> &found_;
};

}  // namespace

std::string unknown_keys(const toml::table &root, const std::string &path,
                         const Visitor::Body &declare) {
  std::vector<Unknown> found;
  Census(GivenTable(root), path, found).look(declare);
  std::stable_sort(found.begin(), found.end(),
                   [](const Unknown &a, const Unknown &b) { return a.order() < b.order(); });
  constexpr std::size_t most = 20;  // of a file that is something else
  std::string text;
  for (std::size_t i = 0; i < std::min(most, found.size()); ++i)
    text += (i == 0 ? "" : "; and ") + found[i].text();
  if (found.size() > most)
    text += fmt::format("; and {} more unknown keys", found.size() - most);
  return text;
}

}  // namespace tourmaline::casefile
