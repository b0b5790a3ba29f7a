#include "case/resolved.h"

#include <string_view>
#include <utility>

#include "case/schema.h"
#include "case/toml_text.h"
#include "tourmaline/case/case.h"

namespace tourmaline::casefile {

namespace {

/// Writes one table. The tables inside it follow its own keys, as TOML wants it.
class Writer : public Visitor {
 public:
  explicit Writer(std::string path) : path_(std::move(path)) {}

  std::string text() const { return keys_ + tables_; }

  void key(const Key &key, Value value) override {
    const std::string text = toml_text(value);
    if (key.used.holds && !text.empty())
      keys_ += key.name + " = " + text + "\n";
  }

  bool given(const Key &, bool present) override { return present; }

  void table(const Key &key, const Body &body) override {
    if (key.used.holds)
      add(key, body, "[", "]");
  }

  int count(const Key &key, int present) override {
    stands_alone_ = key.may_be_table && present == 1;
    return present;
  }

  void entry(const Key &key, int, const Body &body) override {
    add(key, body, stands_alone_ ? "[" : "[[", stands_alone_ ? "]" : "]]");
  }

 private:
  void add(const Key &key, const Body &body, const char *open, const char *close) {
    const std::string path = path_.empty() ? key.name : path_ + "." + key.name;
    Writer inner(path);
    body(inner);
    const std::string text = inner.text();
    if (const std::string value = inner.alone(key.sole); !value.empty())
      keys_ += key.name + " = " + value + "\n";
    else if (!text.empty())
      tables_ += "\n" + (open + path) + close + "\n" + text;
  }

  // The value of that key, if the table says nothing else.
  std::string alone(const std::string &name) const {
    const std::string begin = name + " = ";
    const bool is_all = !name.empty() && tables_.empty() && keys_.starts_with(begin) &&
                        keys_.find('\n') == keys_.size() - 1;
    return is_all ? keys_.substr(begin.size(), keys_.size() - begin.size() - 1) : "";
  }

  std::string path_, keys_, tables_;
  bool stands_alone_ = false;  // the entries at hand are one
};

FormulaVector zero(int dimension) {
  return FormulaVector(static_cast<std::size_t>(dimension), Formula(0.));
}

// An entry of a library says itself what its class is.
void fill_in(MaterialCase &material, int dimension) {
  if (!material.symmetry && !material.library)
    material.symmetry = "6mm";
  if (!material.poling.empty())
    return;
  material.poling = zero(dimension);
  material.poling.back() = Formula(1.);
}

// Defaults that the program has no need to write down.
void fill_in(Case &asked) {
  fill_in(asked.material, asked.dimension);
  for (RegionCase &region : asked.regions)
    fill_in(region.material, asked.dimension);
  if (asked.load.force.empty())
    asked.load.force = zero(asked.dimension);
  if (!asked.initial.from && asked.initial.displacement.empty())
    asked.initial.displacement = zero(asked.dimension);
}

}  // namespace

std::string resolved(const Case &asked) {
  Case copy = asked;
  fill_in(copy);
  Writer writer("");
  declare(writer, copy);
  return writer.text();
}

namespace {

constexpr std::string_view law_of_a_program =
    "# Instead of [contact.friction] stand friction laws of a program: ";

}  // namespace

std::string resolved_with_law(const Case &asked, const std::string &friction_name) {
  const std::string text = resolved(asked);
  return friction_name.empty() ? text : std::string(law_of_a_program) + friction_name + "\n" + text;
}

std::string friction_name_in(const std::string &resolved) {
  if (!resolved.starts_with(law_of_a_program))
    return "";
  const std::size_t begin = law_of_a_program.size();
  return resolved.substr(begin, resolved.find('\n') - begin);
}

}  // namespace tourmaline::casefile
