#include "case/given_table.h"

#include "case/schema.h"
#include "tourmaline/case/case.h"

namespace tourmaline::casefile {

namespace {

class SoleKeyOf : public Visitor {
 public:
  explicit SoleKeyOf(std::string wanted) : wanted_(std::move(wanted)) {}

  std::string sole;

  void key(const Key &, Value) override {}
  bool given(const Key &, bool) override { return true; }
  void table(const Key &key, const Body &body) override {
    const std::string outside = path_;
    path_ += key.name;
    if (path_ == wanted_)
      sole = key.sole;
    path_ += ".";
    body(*this);
    path_ = outside;
  }
  int count(const Key &, int) override { return 1; }
  void entry(const Key &key, int, const Body &body) override { table(key, body); }

 private:
  std::string wanted_, path_;
};

// The only key of these that is a formula, for which a table of values over t may stand as well;
// the others are names of laws.
constexpr const char *sole_formula = "value";

// { points = ... } or { table = ... }, which is a value.
bool is_table_in_time(const toml::table &given) {
  return given.contains("points") || given.contains("table");
}

}  // namespace

std::optional<GivenTable> given_table(const toml::node &node, const Key &key) {
  const toml::table *table = node.as_table();
  if (table && !(key.sole == sole_formula && is_table_in_time(*table)))
    return GivenTable(*table);
  if (!key.sole.empty())
    return GivenTable(node, key.sole);
  return std::nullopt;
}

std::string sole_key_of(const std::string &path) {
  SoleKeyOf search(path);
  Case any;
  declare(search, any);
  return search.sole;
}

}  // namespace tourmaline::casefile
