#include "tourmaline/case/formula.h"

#include <fmt/format.h>
#include <muParser.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <utility>

#include "tourmaline/case/nearest.h"
#include "tourmaline/case/toml_text.h"
#include "tourmaline/error.h"

namespace tourmaline::casefile {

namespace {

// muParser's own `c ? a : b`, in the form that the case files use. A condition that is not a number
// must not pass for true.
double choose(double condition, double yes, double no) {
  if (std::isnan(condition))
    return condition;
  return condition != 0 ? yes : no;
}

double power(double base, double exponent) {
  return std::pow(base, exponent);
}
double remainder_of(double a, double b) {
  return a - b * std::floor(a / b);
}
double round_down(double a) {
  return std::floor(a);
}
double round_up(double a) {
  return std::ceil(a);
}

void define_names(mu::Parser &parser, std::array<double, 4> &variables) {
  parser.DefineConst("pi", std::acos(-1.0));
  parser.DefineFun("if", choose);
  parser.DefineFun("pow", power);
  parser.DefineFun("mod", remainder_of);
  parser.DefineFun("floor", round_down);
  parser.DefineFun("ceil", round_up);
  constexpr const char *names[] = {"x", "y", "z", "t"};
  for (std::size_t i = 0; i < variables.size(); ++i)
    parser.DefineVar(names[i], &variables[i]);
}

[[noreturn]] void fail(const std::string &where, const std::string &text,
                       const std::string &reason) {
  throw CaseError((where.empty() ? "" : where + " = ") + toml_text(shortened(text)) + ": " +
                  reason);
}

// muParser reads "x = 3" as an assignment to x, which nobody who writes a load means.
bool has_assignment(const std::string &text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool compares = i > 0 && std::string_view("=!<>").find(text[i - 1]) != std::string::npos;
    const bool starts_comparison = i + 1 < text.size() && text[i + 1] == '=';
    if (text[i] == '=' && !compares && !starts_comparison)
      return true;
  }
  return false;
}

std::vector<std::string> all_names() {
  const FormulaNames &known = formula_names();
  std::vector<std::string> all = known.variables;
  all.insert(all.end(), known.functions.begin(), known.functions.end());
  all.insert(all.end(), known.constants.begin(), known.constants.end());
  return all;
}

std::string reason_of(const mu::Parser::exception_type &error) {
  std::string reason = error.GetMsg();
  while (!reason.empty() && (reason.back() == '.' || reason.back() == ' '))
    reason.pop_back();
  const std::string &token = error.GetToken();
  const bool unknown = error.GetCode() == mu::ecUNASSIGNABLE_TOKEN;
  const std::vector<std::string> names = all_names();
  const bool known = std::find(names.begin(), names.end(), token) != names.end();
  return "not a formula: " + reason + (unknown && !known ? did_you_mean(token, names) : "");
}

}  // namespace

/// muParser reads its variables from fixed addresses, so that one evaluation at a time is possible.
struct Formula::Expression {
  std::string text;
  mutable std::mutex one_at_a_time;
  mutable std::array<double, 4> variables{};
  mu::Parser parser;

  double evaluate(const std::array<double, 3> &point, double time) const {
    const std::lock_guard lock(one_at_a_time);
    variables = {point[0], point[1], point[2], time};
    return parser.Eval();
  }
};

Formula::Formula(double number, std::string where) : number_(number), where_(std::move(where)) {
  if (!std::isfinite(number))
    throw CaseError(
        fmt::format("{}{}: is not a finite number", where_.empty() ? "" : where_ + " = ", number));
}

Formula::Formula(const std::string &text, std::string where) : where_(std::move(where)) {
  auto expression = std::make_shared<Expression>();
  expression->text = text;
  if (has_assignment(text))
    fail(where_, text, "not a formula: a single \"=\"; two values are compared with \"==\"");
  try {
    define_names(expression->parser, expression->variables);
    expression->parser.SetExpr(text);
    // The first evaluation is the one that parses.
    number_ = expression->parser.Eval();
    if (expression->parser.GetNumResults() != 1)
      fail(where_, text, "not a formula: a comma outside of a function; decimals take a point");
    for (const auto &[name, address] : expression->parser.GetUsedVar())
      (name == "t" ? uses_time_ : uses_place_) = true;
  } catch (const mu::Parser::exception_type &error) {
    fail(where_, text, reason_of(error));
  }
  if (uses_time_ || uses_place_)
    expression_ = std::move(expression);
  else if (!std::isfinite(number_))
    fail(where_, text, fmt::format("is not a finite number ({})", std::abs(number_)));
}

double Formula::value(const std::array<double, 3> &point, double time) const {
  if (!expression_)
    return number_;
  const double value = expression_->evaluate(point, time);
  if (!std::isfinite(value))
    fail(where_, expression_->text,
         fmt::format("is not a finite number ({}) at x = {}, y = {}, z = {} m, t = {} s",
                     std::isnan(value) ? "nan" : "inf", point[0], point[1], point[2], time));
  return value;
}

std::string Formula::text() const {
  return expression_ ? expression_->text : fmt::format("{}", number_);
}

const FormulaNames &formula_names() {
  static const FormulaNames names = [] {
    std::array<double, 4> variables{};
    mu::Parser parser;
    define_names(parser, variables);
    FormulaNames known;
    for (const auto &entry : parser.GetVar())
      known.variables.push_back(entry.first);
    for (const auto &entry : parser.GetFunDef())
      known.functions.push_back(entry.first);
    for (const auto &entry : parser.GetConst())
      known.constants.push_back(entry.first);
    return known;
  }();
  return names;
}

}  // namespace tourmaline::casefile
