#include "tourmaline/case/formula.h"

#include <fmt/format.h>
#include <muParser.h>

#include <algorithm>
#include <cctype>
#include <cfenv>
#include <cmath>
#include <mutex>
#include <utility>

#include "case/double_range.h"
#include "case/load_table.h"
#include "case/nearest.h"
#include "case/toml_text.h"
#include "formula_branches.h"
#include "tourmaline/error.h"

namespace tourmaline::casefile {

namespace {

// Only for its name and its number of arguments: `with_branches` writes it as `c ? a : b`.
double choose(double condition, double yes, double no) {
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

constexpr const char *variable_names[] = {"x", "y", "z", "t"};

void define_names(mu::Parser &parser, std::array<double, 4> &variables) {
  parser.DefineConst("pi", std::acos(-1.0));
  parser.DefineFun("if", choose);
  parser.DefineFun("pow", power);
  parser.DefineFun("mod", remainder_of);
  parser.DefineFun("floor", round_down);
  parser.DefineFun("ceil", round_up);
  for (std::size_t i = 0; i < variables.size(); ++i)
    parser.DefineVar(variable_names[i], &variables[i]);
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

// "1e", where a text begins with a number whose exponent has no digits.
std::string incomplete_number(std::string_view text) {
  const std::size_t letter = text.find_first_not_of("0123456789.");
  if (letter == 0 || letter == std::string_view::npos || (text[letter] | ' ') != 'e')
    return "";
  const auto goes_on = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; };
  const std::string_view behind = text.substr(letter + 1);
  return !behind.empty() && goes_on(behind.front()) ? "" : std::string(text.substr(0, letter + 1));
}

std::string reason_of(const mu::Parser::exception_type &error, const std::string &text) {
  const auto place = std::clamp<std::size_t>(error.GetPos(), 0, text.size());
  if (const std::string number = incomplete_number(std::string_view(text).substr(place));
      !number.empty())
    return fmt::format("not a formula: the number \"{}\" is incomplete, its exponent has no digits",
                       shortened(number));
  std::string reason = error.GetMsg();
  while (!reason.empty() && (reason.back() == '.' || reason.back() == ' '))
    reason.pop_back();
  const std::string &token = error.GetToken();
  if (std::string large = too_large(token); !large.empty())
    return large;
  const bool unknown = error.GetCode() == mu::ecUNASSIGNABLE_TOKEN;
  const std::vector<std::string> names = all_names();
  const bool known = std::find(names.begin(), names.end(), token) != names.end();
  return "not a formula: " + reason + (unknown && !known ? did_you_mean(token, names) : "");
}

}  // namespace

namespace {

/// What one evaluation found.
struct Evaluated {
  double value;
  const char *trouble;  ///< what a value on the way was that is no finite number, or nullptr
};

// A comparison, a condition or a `max` drops what is not a number, and 1/inf is 0; the processor
// remembers for the thread that such a value arose.
template <class Evaluate>
Evaluated watched(const Evaluate &evaluate) {
  constexpr int troubles = FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW;
  if (std::fetestexcept(troubles) != 0)
    std::feclearexcept(troubles);
  const double value = evaluate();
  const int found = std::fetestexcept(troubles);
  if (found != 0)
    std::feclearexcept(troubles);
  if (std::isnan(value) || (found & FE_INVALID) != 0)
    return {value, "nan"};
  return {value, found != 0 || std::isinf(value) ? "inf" : nullptr};
}

std::string complaint_about(const Evaluated &found) {
  return fmt::format("{} not a finite number ({})",
                     std::isfinite(found.value) ? "uses a value on the way that is" : "is",
                     found.trouble);
}

}  // namespace

/// muParser reads its variables from fixed addresses, so that one evaluation at a time is possible.
struct Formula::Expression {
  std::string text;
  Range range;
  std::string unit;
  mutable std::mutex one_at_a_time;
  mutable std::array<double, 4> variables{};
  mu::Parser parser;

  Evaluated evaluate(const std::array<double, 3> &point, double time) const {
    const std::lock_guard lock(one_at_a_time);
    variables = {point[0], point[1], point[2], time};
    return watched([&] { return parser.Eval(); });
  }
};

Formula::Formula(double number, std::string where) : number_(number), where_(std::move(where)) {
  if (!std::isfinite(number))
    throw CaseError(
        fmt::format("{}{}: is not a finite number", where_.empty() ? "" : where_ + " = ", number));
}

namespace {

// What would be read otherwise than it is meant.
constexpr const char *with_comma =
    "not a formula: a comma outside of a function; decimals take a point";

// "1,5 V": as a formula it would be its unit that is wrong.
bool begins_with_decimal_comma(const std::string &text) {
  const std::size_t first = text.find_first_not_of(" \t+-"),
                    comma = text.find_first_not_of("0123456789", std::min(first, text.size()));
  return comma != std::string::npos && comma > first && text[comma] == ',';
}

std::string misreading(const std::string &text) {
  const auto is_control = [](unsigned char c) { return std::iscntrl(c) != 0 && !std::isspace(c); };
  if (std::any_of(text.begin(), text.end(), is_control))
    return "not a formula: it has a control character";
  if (std::string small = too_small(text); !small.empty())
    return small;
  if (begins_with_decimal_comma(text))
    return with_comma;
  if (has_assignment(text))
    return "not a formula: a single \"=\"; two values are compared with \"==\"";
  constexpr int deepest = 200, most_conditions = 1000;
  if (std::count(text.begin(), text.end(), '?') > most_conditions)
    return fmt::format("not a formula: more than {} conditions", most_conditions);
  if (nesting(text) > deepest)
    return fmt::format("not a formula: more than {} parentheses inside each other", deepest);
  return "";
}

}  // namespace

Formula::Formula(const std::string &text, std::string where, const Range &range, std::string unit)
    : where_(std::move(where)) {
  if (const std::string reason = misreading(text); !reason.empty())
    fail(where_, text, reason);
  auto expression = std::make_shared<Expression>();
  expression->text = text;
  expression->range = range;
  expression->unit = std::move(unit);
  mu::Parser &parser = expression->parser;
  try {
    // A constant part must be computed, and watched, whenever it decides: 1/0 in "t < 1/0".
    parser.EnableOptimizer(false);
    define_names(parser, expression->variables);
    parser.SetExpr(text);
    parser.Eval();  // the first evaluation is the one that parses
    if (parser.GetNumResults() != 1)
      fail(where_, text, with_comma);
    for (const auto &[name, address] : parser.GetUsedVar())
      uses_[static_cast<std::size_t>(address - expression->variables.data())] = true;
    parser.SetExpr(with_branches(text));
    parser.Eval();
  } catch (const mu::Parser::exception_type &error) {
    fail(where_, text, reason_of(error, text));
  }
  if (depends_on_time() || depends_on_place()) {
    expression_ = std::move(expression);
    return;
  }
  const Evaluated found = expression->evaluate({}, 0);
  if (found.trouble)
    fail(where_, text, complaint_about(found));
  number_ = found.value;
}

namespace {

// "x = 1, y = 2 m, t = 3 s", of what is used only: the value is the same whatever the others are.
std::string place_words(const std::array<bool, 4> &uses, const std::array<double, 3> &point,
                        double time) {
  std::string words;
  for (std::size_t i = 0; i < point.size(); ++i)
    if (uses[i])
      words += fmt::format("{}{} = {}", words.empty() ? "" : ", ", variable_names[i], point[i]);
  words += words.empty() ? "" : " m";
  if (uses[3])
    words += fmt::format("{}t = {} s", words.empty() ? "" : ", ", time);
  return words;
}

}  // namespace

Formula::Formula(std::shared_ptr<const LoadTable> table, std::string where)
    : table_(std::move(table)), where_(std::move(where)) {
  uses_[3] = true;
}

Formula Formula::found(std::shared_ptr<const double> value) {
  Formula formula;
  formula.found_ = std::move(value);
  formula.uses_[3] = true;
  return formula;
}

double Formula::value(const std::array<double, 3> &point, double time) const {
  if (found_)
    return *found_;
  if (table_)
    return table_->value(time);
  if (!expression_)
    return number_;
  const Evaluated found = expression_->evaluate(point, time);
  if (!found.trouble && expression_->range.contains(found.value) &&
      std::abs(found.value) <= expression_->range.sense.most)
    return found.value;
  const Range &range = expression_->range;
  const std::string reason = found.trouble
                                 ? complaint_about(found)
                                 : fmt::format("is {:g}, but {}", found.value,
                                               complaint(range, found.value, expression_->unit));
  fail(where_, expression_->text, reason + ", at " + place_words(uses_, point, time));
}

std::string Formula::text() const {
  if (table_)
    return table_->text();
  return expression_ ? expression_->text : fmt::format("{}", number_);
}

std::string Formula::in_words() const {
  constexpr std::size_t few = 6;
  if (!table_ || table_->points().size() <= few)
    return text();
  return fmt::format("(table of {} points, t = {} to {} s)", table_->points().size(),
                     table_->begin(), table_->end());
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
