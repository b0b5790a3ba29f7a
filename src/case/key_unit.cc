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
      unit = key.actual_unit();
  }
  bool given(const Key &key, bool present) override {
    const std::string path = path_ + key.name;
    return present || wanted_ == path || wanted_.starts_with(path + ".");
  }
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

}  // namespace

std::string unit_of_key(const std::string &path, const Case &asked) {
  static const std::regex index(R"(\[[^\]]*\]|\.[0-9]+(?=\.|$))");
  UnitOf search(std::regex_replace(path, index, ""));
  Case copy = asked;
  declare(search, copy);
  return search.unit;
}

}  // namespace tourmaline::casefile
