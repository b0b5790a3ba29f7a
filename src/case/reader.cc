#include "tourmaline/case/reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <map>
#include <utility>

#include "case/conflicts.h"
#include "case/contacts.h"
#include "case/double_range.h"
#include "case/electrodes.h"
#include "case/given_table.h"
#include "case/holding.h"
#include "case/left_out.h"
#include "case/plane_formulas.h"
#include "case/probes.h"
#include "case/regime.h"
#include "case/schema.h"
#include "case/tables_in_time.h"
#include "case/unknown_keys.h"
#include "case/utf8.h"
#include "override.h"
#include "tourmaline/error.h"
#include "value.h"

namespace tourmaline::casefile {

namespace {

/// Keys that must be given are not; all others of the table have been read.
struct MissingKeys : CaseError {
  using CaseError::CaseError;
};

/// Reads one table of the case file.
class Reader : public Visitor {
 public:
  /// What the tables inside inherit.
  struct Context {
    std::filesystem::path folder;  ///< of the case
    const MeshFileReader &read_mesh;
    std::function<std::string()> unknown_keys;  ///< what is wrong with all of them
  };

  Reader(const GivenTable &table, std::string path, const Context &context)
      : table_(table), path_(std::move(path)), context_(context) {}

  /// Checks that every key of the table is declared, then reads those that are.
  void read_all(const Body &body) {
    Names names;
    body(names);
    check_laws(names.laws);
    if (const toml::table *keys = table_.keys())
      for (const auto &[name, node] : *keys)
        if (!names.hold(std::string(name.str())))
          throw CaseError(context_.unknown_keys());
    body(*this);
    if (!missing_.empty())
      fail_missing();
  }

  void key(const Key &key, Value value) override {
    if (!is_used(key))
      return;
    if (const toml::node *node = table_.get(key.name))
      read(item(*node, key), value);
    else if (key.required)
      missing_.push_back(key);
  }

  bool given(const Key &key, bool) override {
    const bool present = table_.get(key.name) != nullptr;
    if (!present && key.required) {
      missing_.push_back(key);
      fail_missing();
    }
    return present;
  }

  void table(const Key &key, const Body &body) override {
    if (!is_used(key))
      return;
    const toml::node *node = table_.get(key.name);
    if (!node && key.required) {
      missing_.push_back(key);
      fail_missing();  // what follows depends on it
    }
    if (!node)
      return;
    const std::optional<GivenTable> inner = given_table(*node, key);
    if (!inner)
      fail(item(*node, key), "must be a table: [" + path_to(key.name) + "]");
    Reader(*inner, path_to(key.name), context_).read_all(body);
  }

  int count(const Key &key, int) override {
    const toml::node *node = table_.get(key.name);
    if (!node)
      return 0;
    if (key.may_be_table && node->is_table())
      return 1;
    const toml::array *array = node->as_array();
    const bool tables = array && std::all_of(array->begin(), array->end(),
                                             [](const auto &entry) { return entry.is_table(); });
    if (!tables)
      fail(item(*node, key),
           key.may_be_table
               ? fmt::format("must be a table, [{0}], or several, each under [[{0}]]",
                             path_to(key.name))
               : fmt::format("must be an array of tables; write [[{}]] above each entry",
                             path_to(key.name)));
    if (key.may_be_table && array->empty())
      fail(item(*node, key), "is an empty list; leave it out where there is none");
    return static_cast<int>(array->size());
  }

  void entry(const Key &key, int index, const Body &body) override {
    if (const toml::table *alone = table_.get(key.name)->as_table()) {
      Reader(GivenTable(*alone), path_to(key.name), context_).read_all(body);
      return;
    }
    const toml::node *node = table_.get(key.name)->as_array()->get(static_cast<std::size_t>(index));
    Reader(GivenTable(*node->as_table()), fmt::format("{}[{}]", path_to(key.name), index), context_)
        .read_all(body);
  }

  void check(const std::string &name, const Complaint &complaint) override {
    if (!missing_.empty())
      return;
    const std::string text = complaint();
    if (text.empty())
      return;
    const toml::node *node = table_.get(name);
    if (!node)
      throw CaseError(where(table_.node().source(), name) + ": " + text);
    fail(item(*node, {.name = name, .description = ""}), text);
  }

  void locate(const std::string &name, std::string &file) override {
    const toml::node *node = table_.get(name);
    if (!node)
      return;
    if (file.empty())
      fail(item(*node, {.name = name, .description = ""}), "names nothing");
    file = std::filesystem::absolute(context_.folder / file).lexically_normal().string();
    if (!is_utf8(file))
      fail(item(*node, {.name = name, .description = ""}),
           "lies in a folder whose name is not UTF-8, as resolved.toml could not name it (" +
               readable(file) + "); rename the folder");
  }

  void load(MeshCase &mesh) override {
    if (!mesh.file)
      return;
    const Item file = item(*table_.get("file"), {.name = "file", .description = ""});
    if (!context_.read_mesh)
      fail(file, "mesh files cannot be read here; give mesh.box instead");
    try {
      mesh.content = context_.read_mesh(mesh);
    } catch (const CaseError &error) {
      fail(file, error.what() + (" (" + *mesh.file + ")"));
    }
  }

  void place(std::string &where_) override { where_ = where(table_.node().source(), ""); }

  void places(std::map<std::string, std::string> &where_) override {
    if (const toml::table *keys = table_.keys())
      for (const auto &[name, node] : *keys)
        where_[std::string(name.str())] = where(node.source(), std::string(name.str()));
    else
      where_[table_.sole()] = where(table_.node().source(), table_.sole());
  }

 private:
  std::string path_to(const std::string &name) const {
    return path_.empty() ? name : path_ + "." + name;
  }

  // " [contact.friction] bound"; an empty name stands for the table itself.
  std::string full_name(const std::string &name) const {
    if (is_sole(name))
      return name_of_value();
    return (path_.empty() ? "" : " [" + path_ + "]") + (name.empty() ? "" : " " + name);
  }

  bool is_sole(const std::string &name) const {
    return !table_.keys() && (name.empty() || name == table_.sole());
  }

  // Of a value that is given for this table: " [contact] normal".
  std::string name_of_value() const {
    const std::size_t dot = path_.rfind('.');
    return dot == std::string::npos
               ? " " + path_
               : fmt::format(" [{}] {}", path_.substr(0, dot), path_.substr(dot + 1));
  }

  bool is_used(const Key &key) const {
    const toml::node *node = table_.get(key.name);
    if (!key.used.holds && node)
      fail(item(*node, key), "is only used with " + key.used.words);
    return key.used.holds;
  }

  std::string where(const toml::source_region &source, const std::string &name) const {
    return place_of(source) + full_name(name);
  }

  Item item(const toml::node &node, const Key &key) const {
    return {node, key, full_name(key.name), is_sole(key.name) ? "a table, [" + path_ + "]" : "",
            context_.folder};
  }

  // A law that does not exist is the mistake, and not the keys that it would have.
  void check_laws(const std::vector<Key> &laws) const {
    std::string ignored;
    for (const Key &law : laws)
      if (const toml::node *node = table_.get(law.name))
        read(item(*node, law), &ignored);
  }

  // The others are for the reference.
  static std::string first_sentence(const std::string &text) {
    return text.substr(0, text.find(". "));
  }

  [[noreturn]] void fail_missing() const {
    std::string names, meanings;
    for (const Key &key : missing_) {
      const std::string unit = key.unit.empty() ? "" : " [" + key.unit + "]";
      names += (names.empty() ? "" : ", ") + key.name;
      meanings += (meanings.empty() ? "" : "; ") + (missing_.size() > 1 ? key.name + ", " : "") +
                  first_sentence(key.description) + unit;
    }
    throw MissingKeys(fmt::format("{}: missing, but must be given: {}{}",
                                  where(table_.node().source(), names), meanings, as_table()));
  }

  // How to give further keys where a value is given: "; write normal = { law = "damped",
  // coefficient = ... }".
  std::string as_table() const {
    if (table_.keys())
      return "";
    std::string keys = table_.sole() + " = " + quoted(table_.node());
    for (const Key &key : missing_)
      keys += ", " + key.name + " = ...";
    return fmt::format("; write {} = {{ {} }}", path_.substr(path_.rfind('.') + 1), keys);
  }

  GivenTable table_;
  std::string path_;  ///< of the table, with dots
  std::vector<Key> missing_;
  const Context &context_;
};

toml::table case_table(const std::string &text, const std::string &name) {
  if (text.find('\0') != std::string::npos)
    throw CaseError(name + ": is not a text file");
  require_utf8(text, name);
  if (text.find_first_not_of(" \t\r\n") == std::string::npos)
    throw CaseError(name + ": is empty; a case needs at least [mesh], [material] and [time]");
  if (const auto small = too_small_in_toml(text))
    throw CaseError(fmt::format("{}:{}: {}", name, small->line, small->reason));
  try {
    return toml::parse(text, std::string_view(name));
  } catch (const toml::parse_error &error) {
    throw CaseError(
        fmt::format("{}: is not TOML: {}", place_of(error.source()), toml_complaint(error)));
  }
}

// No more field files than anybody wants to look through.
int steps_between_files(int steps) {
  constexpr int files = 50;
  return (steps - 1) / files + 1;
}

std::string text_of_file(const std::filesystem::path &file) {
  const std::string name = file.string();
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored))
    throw CaseError(name + ": there is no such file");
  if (std::filesystem::is_directory(file, ignored))
    throw CaseError(name + ": is a folder; the case file inside it is needed");
  std::ifstream in(file, std::ios::binary);
  // Not a file's size, which a pipe does not have.
  constexpr std::size_t most = 16 << 20;
  std::string text(most + 1, '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(in.gcount()));
  if (!in.eof() && text.size() <= most)
    throw CaseError(name + ": cannot be read");
  if (text.size() > most)
    throw CaseError(name + ": is larger than 16 MiB, which no case file is");
  return text;
}

}  // namespace

Case read_text(const std::string &text, const std::string &name,
               const std::vector<std::string> &overrides, const MeshFileReader &read_mesh) {
  toml::table root = case_table(text, name);
  for (const std::string &assignment : overrides)
    apply_override(root, assignment);
  Case asked;
  asked.source = name;
  const auto unknown = [&] {
    Case scratch;
    return unknown_keys(root, "", [&](Visitor &visitor) { declare(visitor, scratch); });
  };
  const Reader::Context context{std::filesystem::path(name).parent_path(), read_mesh, unknown};
  Reader(GivenTable(root), "", context).read_all([&](Visitor &visitor) {
    declare(visitor, asked);
  });
  if (!asked.output.every && !asked.time.tolerance)
    asked.output.every = steps_between_files(asked.time.steps);
  check_plane(asked);
  check_tables(asked);
  check_left_out(asked);
  check_conflicts(asked);
  check_contacts(asked);
  check_electrodes(asked);
  check_probes(asked);
  check_holding(asked);
  check_regime(asked);
  return asked;
}

namespace {

void read_entry(const toml::node &node, const std::string &file, MaterialEntry &entry) {
  const toml::table *table = node.as_table();
  if (!table)
    throw CaseError(fmt::format("{} {}: must be a table, the material of that name",
                                place_of(node.source()), entry.name));
  const MeshFileReader none;
  const auto unknown = [&] {
    MaterialCase scratch;
    return unknown_keys(*table, entry.name,
                        [&](Visitor &visitor) { declare_entry(visitor, scratch); });
  };
  const Reader::Context context{std::filesystem::path(file).parent_path(), none, unknown};
  Reader(GivenTable(*table), entry.name, context).read_all([&](Visitor &visitor) {
    declare_entry(visitor, entry.given);
  });
}

}  // namespace

std::vector<MaterialEntry> read_materials(const std::string &text, const std::string &name) {
  const toml::table root = case_table(text, name);
  std::vector<MaterialEntry> entries;
  for (const auto &[key, node] : root) {
    entries.push_back({std::string(key.str()), {}, {}});
    try {
      read_entry(node, name, entries.back());
    } catch (const MissingKeys &error) {
      entries.back().mistake = error.what();
    } catch (const CaseError &error) {
      entries.back().mistake = error.what();
      entries.back().given = {};  // half of which is there
    }
  }
  return entries;
}

std::vector<MaterialEntry> read_materials(const std::filesystem::path &file) {
  return read_materials(text_of_file(file), file.string());
}

Case read_file(const std::filesystem::path &file, const std::vector<std::string> &overrides,
               const MeshFileReader &read_mesh) {
  return read_text(text_of_file(file), file.string(), overrides, read_mesh);
}

}  // namespace tourmaline::casefile
