#include "case/plane_formulas.h"

#include <fmt/format.h>

#include "case/schema.h"
#include "case/toml_text.h"
#include "tourmaline/case/case.h"
#include "tourmaline/error.h"

namespace tourmaline::casefile {

namespace {

/// Looks at every formula that a case has.
class InThePlane : public Visitor {
 public:
  void key(const Key &, Value value) override {
    if (const auto *formula = std::get_if<Formula *>(&value))
      look(**formula);
    if (const auto *formulas = std::get_if<FormulaVector *>(&value))
      for (const Formula &formula : **formulas)
        look(formula);
    if (const auto *components = std::get_if<Displacement *>(&value))
      for (const std::optional<Formula> &formula : **components)
        if (formula)
          look(*formula);
  }
  bool given(const Key &, bool present) override { return present; }
  void table(const Key &, const Body &body) override { body(*this); }
  int count(const Key &, int present) override { return present; }
  void entry(const Key &, int, const Body &body) override { body(*this); }

 private:
  static void look(const Formula &formula) {
    if (formula.depends_on_z())
      throw CaseError(
          fmt::format("{} = {}: a two-dimensional case has no z, its coordinates are x "
                      "and y; allowed: x, y, t",
                      formula.where(), toml_text(shortened(formula.text()))));
  }
};

}  // namespace

void check_plane(const Case &asked) {
  if (asked.dimension != 2)
    return;
  Case copy = asked;
  InThePlane visitor;
  declare(visitor, copy);
}

}  // namespace tourmaline::casefile
