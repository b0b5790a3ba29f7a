#pragma once

#include <toml++/toml.h>
#include <filesystem>
#include <string>

#include "case/schema.h"

namespace tourmaline::casefile {

/// `file:line:column`, or the `--set` that a value comes from.
std::string place_of(const toml::source_region &source);

/// What TOML's reader has to say against a text.
std::string toml_complaint(const toml::parse_error &error);

/// A value as an error text quotes it: on one line, and not all of it when it is long.
std::string quoted(const toml::node &node);

/// A TOML value with the key that declares it and where it stands.
struct Item {
  const toml::node &node;
  const Key &key;
  std::string name;                   ///< with its table: " [contact.friction] bound"
  std::string otherwise = {};         ///< what may be given instead of a value of the key's type
  std::filesystem::path folder = {};  ///< that names of files count from: of the case

  /// What error texts begin with: place, table and key.
  std::string where() const { return place_of(node.source()) + name; }
};

/// Throws CaseError: where, what was given, `reason`.
[[noreturn]] void fail(const Item &item, const std::string &reason);

/// Reads the item into `value` and checks it against everything that the key declares.
void read(const Item &item, Value value);

}  // namespace tourmaline::casefile
