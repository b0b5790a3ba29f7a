#include "case/tables_in_time.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "case/each_formula.h"
#include "case/load_table.h"
#include "case/toml_text.h"
#include "tourmaline/case/case.h"
#include "tourmaline/error.h"

namespace tourmaline::casefile {

namespace {

using Look = std::function<void(const Formula &formula, const LoadTable &table)>;

void for_each_table(const Case &asked, const Look &look) {
  for_each_formula(asked, [&](const Formula &formula) {
    if (const LoadTable *table = formula.table())
      look(formula, *table);
  });
}

// An end that differs by round-off, as of a sum of steps, is the same.
double same_time(const Case &asked) {
  return 1e-9 * asked.time.end;
}

void require_all_times(const Case &asked, const Formula &formula, const LoadTable &table) {
  const double same = same_time(asked), end = asked.time.end;
  if (table.begin() <= same && table.end() >= end - same)
    return;
  throw CaseError(fmt::format(
      "{} = {}: {} goes from t = {} s to {} s, the run from 0 to {} s; give the table "
      "points at the ends of the run, as nothing says what is outside it",
      formula.where(), shortened(formula.text()), table.called(), table.begin(), table.end(), end));
}

// Where the slope changes by more than the points' own round-off.
void add_bends(const LoadTable &table, std::vector<double> &times) {
  const LoadTable::Points &points = table.points();
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    const auto [t0, v0] = points[i - 1];
    const auto [t, v] = points[i];
    const auto [t1, v1] = points[i + 1];
    const double between = v0 + (v1 - v0) * ((t - t0) / (t1 - t0));
    if (std::abs(v - between) > 1e-12 * std::max({std::abs(v0), std::abs(v), std::abs(v1)}))
      times.push_back(t);
  }
}

}  // namespace

void check_tables(const Case &asked) {
  for_each_table(asked, [&](const Formula &formula, const LoadTable &table) {
    require_all_times(asked, formula, table);
  });
}

std::vector<std::string> table_warnings(const Case &asked) {
  constexpr double far = 100;
  std::vector<std::string> warnings;
  for_each_table(asked, [&](const Formula &formula, const LoadTable &table) {
    if (table.end() > far * asked.time.end)
      warnings.push_back(
          fmt::format("{}: {} goes on until t = {:g} s, and the run ends at {:g} s, so that hardly "
                      "any of it is "
                      "used; times of tables are in s",
                      formula.where(), table.called(), table.end(), asked.time.end));
  });
  return warnings;
}

std::vector<double> bends(const Case &asked) {
  std::vector<double> times;
  for_each_table(asked, [&](const Formula &, const LoadTable &table) { add_bends(table, times); });
  std::sort(times.begin(), times.end());
  std::vector<double> inside;
  for (const double time : times)
    if (time - (inside.empty() ? 0 : inside.back()) > same_time(asked) &&
        asked.time.end - time > same_time(asked))
      inside.push_back(time);
  return inside;
}

}  // namespace tourmaline::casefile
