#include "case/key_unit.h"

#include <regex>

#include "case/schema.h"
#include "tourmaline/case/case.h"

namespace tourmaline::casefile {

namespace {

class UnitOf : public Visitor {
 public:
  explicit UnitOf(std::string wanted) : wanted_(std::move(wanted)) {}

  std::string unit;

  void key(const Key &key, Value) override {
    if (path_ + key.name == wanted_)
      unit = key.unit;
  }
  bool given(const Key &, bool) override { return true; }
  void table(const Key &key, const Body &body) override {
    const std::string outside = path_;
    if (!key.sole.empty() && path_ + key.name == wanted_)
      wanted_ += "." + key.sole;
    path_ += key.name + ".";
    body(*this);
    path_ = outside;
  }
  int count(const Key &, int) override { return 1; }
  void entry(const Key &key, int, const Body &body) override { table(key, body); }

 private:
  std::string wanted_, path_;
};

// "ohm (plane bodies: ohm m)" is the one or the other.
std::string unit_in(int dimension, const std::string &unit) {
  static const std::regex both(R"((.+) \(plane bodies: (.+)\))");
  std::smatch found;
  if (!std::regex_match(unit, found, both))
    return unit;
  return found[dimension == 2 ? 2 : 1];
}

}  // namespace

std::string unit_of_key(const std::string &path, int dimension) {
  static const std::regex index(R"(\[[0-9]+\]|\.[0-9]+(?=\.|$))");
  UnitOf search(std::regex_replace(path, index, ""));
  Case any;
  declare(search, any);
  return unit_in(dimension, search.unit);
}

}  // namespace tourmaline::casefile
