#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "tourmaline/case/range.h"

namespace tourmaline::casefile {

class LoadTable;

/// A number, a muParser expression in x, y, z [m] and t [s], or a table of values over t, as it
/// stands in the case file.
///
/// Besides muParser's own operators and functions it knows `if(c, a, b)` and `pi`. Of `if`, `?:`,
/// `&&` and `||` only what decides is evaluated. Where any value that is evaluated on the way is
/// infinite or not a number, a comparison or a `max` could hide it from the result: that is an
/// error like a result that is not finite. `value` throws CaseError with `where()`, the text and
/// those of the point's coordinates and the time that it depends on.
class Formula {
 public:
  Formula() : Formula(0.0) {}
  /// The number must be finite.
  /*implicit*/ Formula(double number, std::string where = {});
  /// Throws CaseError with muParser's reason when the text does not parse, and when it uses no
  /// variable and is not finite. An expression without variables becomes its number. `where` is
  /// what an error begins with: file, line and key. Values of an expression with variables that are
  /// not in `range` are errors as well, in that unit; a number is judged by who reads it.
  explicit Formula(const std::string &text, std::string where = {}, const Range &range = {},
                   std::string unit = {});

  /// Piecewise linear in t, as the table says.
  explicit Formula(std::shared_ptr<const LoadTable> table, std::string where = {});
  /// What stands at `value` whenever it is asked: of what a step finds.
  static Formula found(std::shared_ptr<const double> value);

  /// Safe to call from several threads at once.
  double value(const std::array<double, 3> &point, double time) const;

  bool is_number() const { return !expression_ && !table_ && !found_; }
  /// What is given instead of an expression; nullptr: nothing is.
  const LoadTable *table() const { return table_.get(); }
  bool is_zero() const { return is_number() && number_ == 0; }
  bool depends_on_time() const { return uses_[3]; }
  bool depends_on_place() const { return uses_[0] || uses_[1] || uses_[2]; }
  bool depends_on_z() const { return uses_[2]; }
  /// The number with as many digits (at most 17) as reading the same number back takes, the
  /// expression, or the table's points as TOML.
  std::string text() const;
  /// The same for people, to whom many points of a table are their number.
  std::string in_words() const;
  const std::string &where() const { return where_; }

 private:
  struct Expression;

  double number_ = 0;
  std::shared_ptr<const Expression> expression_;
  std::shared_ptr<const LoadTable> table_;
  std::shared_ptr<const double> found_;
  std::array<bool, 4> uses_{};  // x, y, z, t
  std::string where_;
};

using FormulaVector = std::vector<Formula>;

/// What a formula may be made of, as muParser knows it.
struct FormulaNames {
  std::vector<std::string> variables, functions, constants;
};
const FormulaNames &formula_names();

}  // namespace tourmaline::casefile
