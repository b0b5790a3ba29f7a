#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "output/checkpoint.h"
#include "output/records.h"

namespace tourmaline::run {

/// What one wants to know of a run's history when it is over, collected step by step.
class Highlights {
 public:
  void see(const output::HistoryRow &row);
  void save(output::SavedNumbers &numbers) const;
  void restore(const output::SavedNumbers &numbers);

  /// Contact nodes that stick, slip and are open in the last step.
  const output::HistoryRow &last() const { return last_; }
  /// The largest of the balances' errors over all steps, relative; "" when there was none.
  const std::string &imbalance_name() const { return imbalance_name_; }
  double imbalance() const { return imbalance_; }
  int imbalance_step() const { return imbalance_step_; }

 private:
  output::HistoryRow last_;
  std::string imbalance_name_;
  double imbalance_ = -1;  // below every error
  int imbalance_step_ = 0;
};

/// What a run says at its end: extremes with their places, contact, balances, where the results
/// are; a line each. `dimension` coordinates a place, in a body of that size [m].
std::string ending_text(int dimension, const Highlights &highlights,
                        const std::vector<output::Extreme> &extremes, double size);

/// The lines that name the folder and the page, where there is one.
std::string places_text(const std::filesystem::path &directory);

}  // namespace tourmaline::run
