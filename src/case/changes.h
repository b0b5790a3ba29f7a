#pragma once

#include <string>
#include <vector>

namespace tourmaline::casefile {

/// A key whose value differs between two cases; empty where a case does not have it.
struct Change {
  std::string key;        ///< by its path, as `--set` takes it
  std::string then, now;  ///< as TOML
};

/// How two cases, as `resolved` writes them, differ.
std::vector<Change> changes(const std::string &then, const std::string &now);

}  // namespace tourmaline::casefile
