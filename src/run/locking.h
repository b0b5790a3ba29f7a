#pragma once

#include <string>
#include <vector>

#include "output/checkpoint.h"
#include "output/records.h"
#include "solve/model.h"

namespace tourmaline::run {

/// Looks whether linear cells are too stiff for how the body bent, at the step of the run that had
/// the largest elastic energy. Nothing to do for degree 2 and for incompatible modes.
template <int dim>
class LockingWatch {
 public:
  explicit LockingWatch(const solve::Model<dim> &model);

  void step(const output::HistoryRow &row, const std::vector<double> &state);
  /// For the summary, empty when all is well; all ranks ask together.
  std::string warning() const;
  void save(output::SavedNumbers &numbers) const;
  void restore(const output::SavedNumbers &numbers);

 private:
  const solve::Model<dim> &model_;
  bool is_needed_;
  double largest_ = 0;            // elastic energy [J]
  std::vector<double> strained_;  // the state that had it
};

/// What the mesh alone tells: of a slender body with linear cells how many times too stiff it would
/// be if it were bent. Empty when the cells do or when that cannot be told. For `tourmaline check`.
std::string slender_warning(const casefile::Case &asked);

}  // namespace tourmaline::run
