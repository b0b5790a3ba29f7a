#include "case/tables_in_time.h"

#include <fmt/format.h>

#include "case/load_table.h"
#include "case/schema.h"
#include "case/toml_text.h"
#include "tourmaline/case/case.h"
#include "tourmaline/error.h"

namespace tourmaline::casefile {

namespace {

/// Looks at every table that a case has.
class OverTheRun : public Visitor {
 public:
  explicit OverTheRun(double end) : end_(end) {}

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
  // An end that differs by round-off, as of a sum of steps, is the same.
  void look(const Formula &formula) const {
    const LoadTable *table = formula.table();
    if (!table)
      return;
    const double same = 1e-9 * end_;
    if (table->begin() <= same && table->end() >= end_ - same)
      return;
    throw CaseError(fmt::format(
        "{} = {}: the table goes from t = {} s to {} s, the run from 0 to {} s; give the table "
        "points at the ends of the run, as nothing says what is outside it",
        formula.where(), shortened(formula.text()), table->begin(), table->end(), end_));
  }

  double end_;
};

}  // namespace

void check_tables(const Case &asked) {
  Case copy = asked;
  OverTheRun visitor(asked.time.end);
  declare(visitor, copy);
}

}  // namespace tourmaline::casefile
