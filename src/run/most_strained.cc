#include "run/most_strained.h"

#include <algorithm>

namespace tourmaline::run {

void MostStrained::step(const output::HistoryRow &row, const std::vector<double> &state) {
  const auto elastic = std::find_if(row.quantities.begin(), row.quantities.end(),
                                    [](const auto &q) { return q.first == "elastic_energy"; });
  if (elastic == row.quantities.end() || !(elastic->second > largest_))
    return;
  largest_ = elastic->second;
  step_ = row.step;
  time_ = row.time;
  state_ = state;
}

void MostStrained::save(output::SavedNumbers &numbers) const {
  numbers.put("largest elastic energy", {largest_, static_cast<double>(step_), time_});
  numbers.put_field("most strained state", state_);
}

void MostStrained::restore(const output::SavedNumbers &numbers) {
  const auto saved = numbers.get("largest elastic energy", 3);
  largest_ = saved[0];
  step_ = static_cast<int>(saved[1]);
  time_ = saved[2];
  numbers.fill("most strained state", state_);
}

}  // namespace tourmaline::run
