#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "output/records.h"

namespace tourmaline::run {

/// The last look at a step's numbers before any of them is written: NaN and infinity are never
/// results. Every check throws SolveError, with field, place, step and time, why, and what to try.
/// What a rank alone may have, nodes and cells, is checked inside `parallel::together`.
class StepCheck {
 public:
  StepCheck(int step, double time) : step_(step), time_(time) {}

  /// Unknowns by node: `dimension` displacements, the potential, the temperature.
  void state(int dimension, const std::vector<Vector3> &places,
             std::span<const double> state) const;
  /// The step's right-hand side, likewise.
  void loads(int dimension, const std::vector<Vector3> &places,
             std::span<const double> loads) const;
  void contact(const std::vector<output::ContactRow> &rows) const;
  void fields(const output::Grid &grid, const output::CellFields &fields) const;
  /// Columns of history.csv.
  void quantities(const std::vector<std::pair<std::string, double>> &columns) const;

 private:
  void unknowns(int dimension, const std::vector<Vector3> &places, std::span<const double> values,
                const char *const names[3]) const;
  [[noreturn]] void refuse(const std::string &what, double value) const;

  int step_;
  double time_;
};

}  // namespace tourmaline::run
