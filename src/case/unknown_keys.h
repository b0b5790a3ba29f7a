#pragma once

#include <toml++/toml.h>
#include <string>
#include <utility>
#include <vector>

#include "case/visitor.h"

namespace tourmaline::casefile {

/// The names of the keys and tables directly inside one table.
class Names : public Visitor {
 public:
  std::vector<std::string> all;
  std::vector<std::pair<std::string, std::string>> refused;  ///< with the reason
  std::vector<std::pair<std::string, std::string>> also;     ///< other names, and the key's
  std::vector<Key> laws;  ///< on whose texts it may depend which other keys there are

  void key(const Key &key, Value value) override;
  bool given(const Key &key, bool) override;
  void table(const Key &key, const Body &body) override;
  int count(const Key &key, int) override;
  void entry(const Key &, int, const Body &) override {}
  void refuse(const std::string &name, const std::string &reason) override;

  bool hold(const std::string &name) const;

 private:
  void add(const Key &key);
};

/// What is wrong with every key of `root`, and of the tables inside, that is not declared there:
/// place, value, the nearest name or what is allowed, in the order of the file; empty when nothing
/// is. Values that are wrong are passed over, and so are tables with a law that does not exist, as
/// nobody knows what keys these have. `path` is that of `root`, with dots.
std::string unknown_keys(const toml::table &root, const std::string &path,
                         const Visitor::Body &declare);

}  // namespace tourmaline::casefile
