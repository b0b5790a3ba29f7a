#include "case/each_formula.h"

#include "case/schema.h"

namespace tourmaline::casefile {

namespace {

class EachFormula : public Visitor {
 public:
  explicit EachFormula(const std::function<void(const Formula &)> &look) : look_(look) {}

  void key(const Key &, Value value) override {
    if (const auto *formula = std::get_if<Formula *>(&value))
      look_(**formula);
    if (const auto *formulas = std::get_if<FormulaVector *>(&value))
      for (const Formula &formula : **formulas)
        look_(formula);
    if (const auto *components = std::get_if<Displacement *>(&value))
      for (const std::optional<Formula> &formula : **components)
        if (formula)
          look_(*formula);
  }
  bool given(const Key &, bool present) override { return present; }
  void table(const Key &, const Body &body) override { body(*this); }
  int count(const Key &, int present) override { return present; }
  void entry(const Key &, int, const Body &body) override { body(*this); }

 private:
  const std::function<void(const Formula &)> &look_;
};

}  // namespace

void for_each_formula(const Case &asked, const std::function<void(const Formula &)> &look) {
  Case copy = asked;  // a visitor may write
  EachFormula visitor(look);
  declare(visitor, copy);
}

}  // namespace tourmaline::casefile
