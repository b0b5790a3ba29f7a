#pragma once

#include <toml++/toml.h>
#include <optional>
#include <string>
#include <utility>

#include "case/visitor.h"

namespace tourmaline::casefile {

/// What a case file gives for a table: the table, or a value that stands for its key `sole`. What
/// is given must outlive it.
class GivenTable {
 public:
  explicit GivenTable(const toml::table &table) : node_(table), keys_(&table) {}
  GivenTable(const toml::node &value, std::string sole) : node_(value), sole_(std::move(sole)) {}

  /// The key whose value is all that is given; empty: a table is.
  const std::string &sole() const { return sole_; }
  /// nullptr: a value is given.
  const toml::table *keys() const { return keys_; }
  const toml::node &node() const { return node_; }

  const toml::node *get(const std::string &name) const {
    return keys_ ? keys_->get(name) : name == sole_ ? &node_ : nullptr;
  }

 private:
  const toml::node &node_;
  const toml::table *keys_ = nullptr;
  std::string sole_;
};

/// Nothing where neither a table is given nor a value that may stand for one.
std::optional<GivenTable> given_table(const toml::node &node, const Key &key);

/// The key of the table at that path, with dots and without the numbers of entries, whose value may
/// stand for the table; empty where there is none.
std::string sole_key_of(const std::string &path);

}  // namespace tourmaline::casefile
