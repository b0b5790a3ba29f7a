#include "contact/values.h"

#include <fmt/format.h>

#include "printed_number.h"
#include "tourmaline/error.h"

namespace tourmaline::contact {

using casefile::Formula;

namespace {

double require(bool is_so, double value, const Formula &formula, const Vector3 &point, double time,
               const char *what, const std::string &wanted) {
  if (is_so)
    return value;
  throw CaseError(fmt::format("{}: {} is {:g} at ({:g}, {:g}, {:g}), t = {:g} s; it must be {}",
                              formula.where(), what, value, point[0], point[1], point[2], time,
                              wanted));
}

}  // namespace

double value_from(double least, const Formula &formula, const Vector3 &point, double time,
                  const char *what) {
  const double value = formula.value(point, time);
  return require(value >= least, value, formula, point, time, what, fmt::format(">= {:g}", least));
}

double not_negative(const Formula &formula, const Vector3 &point, double time, const char *what) {
  return value_from(0, formula, point, time, what);
}

double positive(const Formula &formula, const Vector3 &point, const char *what) {
  const double value = formula.value(point, 0);
  return require(value > 0, value, formula, point, 0, what, "> 0");
}

std::string text_of(const Formula &formula) {
  const bool is_constant = !formula.depends_on_time() && !formula.depends_on_place();
  return is_constant ? number_text(formula.value({}, 0), 6) : formula.in_words();
}

}  // namespace tourmaline::contact
