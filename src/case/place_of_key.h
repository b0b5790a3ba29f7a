#pragma once

#include <map>
#include <string>

namespace tourmaline::casefile {

/// Where the key of that name stands among `places`; of a table made by a program, which has no
/// places, by the table's own.
inline std::string place_of_key(const std::map<std::string, std::string> &places,
                                const std::string &table, const std::string &key) {
  const auto found = places.find(key);
  return found == places.end() ? table + " " + key : found->second;
}

}  // namespace tourmaline::casefile
