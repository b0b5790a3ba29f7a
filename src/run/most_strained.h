#pragma once

#include <vector>

#include "output/checkpoint.h"
#include "output/records.h"

namespace tourmaline::run {

/// The state of a run that had the largest elastic energy: what strains do wrong, they do most
/// there, even if they have gone again at the end.
class MostStrained {
 public:
  explicit MostStrained(std::size_t n_unknowns) : state_(n_unknowns) {}

  void step(const output::HistoryRow &row, const std::vector<double> &state);

  /// 0 everywhere as long as there was no elastic energy.
  const std::vector<double> &state() const { return state_; }
  int step() const { return step_; }  ///< 0: there was none
  double time() const { return time_; }

  void save(output::SavedNumbers &numbers) const;
  void restore(const output::SavedNumbers &numbers);

 private:
  double largest_ = 0;  // elastic energy [J]
  int step_ = 0;
  double time_ = 0;
  std::vector<double> state_;
};

}  // namespace tourmaline::run
