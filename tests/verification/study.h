#pragma once

#include <fmt/format.h>

#include "error_norms.h"

namespace tourmaline::verified {

/// One kind of element on a sequence of meshes, by their intervals along an axis.
struct Study {
  std::string name;
  casefile::CellShape shape;
  int degree;
  std::vector<int> cells;
  std::string modes = "none";
};

inline void PrintTo(const Study &study, std::ostream *out) {
  *out << study.name;
}

inline std::string name_of(const ::testing::TestParamInfo<Study> &study) {
  return study.param.name;
}

/// Without optimisation the finest mesh in space takes half a minute; the rates of the coarser ones
/// lie in the same windows.
inline std::vector<int> affordable_cells(const Study &study) {
  std::vector<int> cells = study.cells;
#ifndef NDEBUG
  if (casefile::dimension_of(study.shape) == 3)
    cells.pop_back();
#endif
  return cells;
}

/// Leaves "L2_u@16 = 1.234e-03 (1.99)" and its like in the test's XML or JSON report; tables are
/// made of them.
inline void record(const char *norm, const char *field, int cells, double error, double rate) {
  ::testing::Test::RecordProperty(
      fmt::format("{}_{}@{}", norm, field, cells),
      rate > 0 ? fmt::format("{:.3e} ({:.2f})", error, rate) : fmt::format("{:.3e}", error));
}

/// Of errors on n and then m intervals.
inline double order_between(int n, double error_n, int m, double error_m) {
  return std::log(error_n / error_m) / std::log(double(m) / n);
}

/// Least and largest rate.
using Window = std::pair<double, double>;

/// Records all errors and expects the last rate of each to lie in its window.
inline void expect_rates(const std::vector<int> &cells, const std::vector<Errors> &errors,
                         const Window &l2, const Window &h1) {
  const std::array<const char *, 3> fields{"u", "phi", "theta"};
  const auto check = [&](const char *norm, auto member, const Window &window) {
    for (std::size_t f = 0; f < 3; ++f) {
      double rate = 0;
      for (std::size_t i = 0; i < cells.size(); ++i) {
        if (i > 0)
          rate = order_between(cells[i - 1], (errors[i - 1].*member)[f], cells[i],
                               (errors[i].*member)[f]);
        record(norm, fields[f], cells[i], (errors[i].*member)[f], rate);
      }
      EXPECT_GT(rate, window.first) << norm << " of " << fields[f];
      EXPECT_LT(rate, window.second) << norm << " of " << fields[f];
    }
  };
  check("L2", &Errors::l2, l2);
  check("H1", &Errors::h1, h1);
}

/// Rates on meshes that are still coarse differ from the orders by terms of the next order. A wrong
/// term or a missing coupling leaves an error that does not fall, rate 0; a wrong quadrature or
/// boundary term costs half an order or more.
inline void expect_orders_of_the_element(const Study &study, const std::vector<Errors> &errors) {
  expect_rates(affordable_cells(study), errors, {study.degree + 0.9, study.degree + 1.2},
               {study.degree - 0.1, study.degree + 0.2});
}

/// Runs the problem on all meshes of the study.
template <int dim>
void expect_orders(const Study &study, Problem<dim> problem) {
  std::vector<Errors> errors;
  problem.asked.mesh.modes = study.modes;
  for (const int n : affordable_cells(study)) {
    problem.on_mesh(study.shape, study.degree, n);
    errors.push_back(errors_of_run(problem, RunCase(problem.asked)));
  }
  expect_orders_of_the_element(study, errors);
}

}  // namespace tourmaline::verified
