#include "run/schedule.h"

#include <array>

#include "parallel/ranks.h"

namespace tourmaline::run {

bool writes_fields(const casefile::Case &asked, int n) {
  return asked.output.fields && (n % asked.output.every == 0 || n == asked.time.steps);
}

bool Schedule::is_due(int step) const {
  if (interval_.steps > 0)
    return step % interval_.steps == 0;
  const std::chrono::duration<double> passed = Clock::now() - last_;
  return interval_.seconds > 0 && passed.count() >= interval_.seconds;
}

// Signals may reach any rank; of the clocks the first rank's counts.
Schedule::Pause Schedule::after(int step) {
  std::array<double, 2> wishes{parallel::is_first() && is_due(step) ? 1. : 0.,
                               static_cast<double>(signals_.received())};
  parallel::largest(wishes);
  const int stopped_by = static_cast<int>(wishes[1]);
  const bool saves = wishes[0] > 0 || stopped_by != 0;
  if (saves)
    last_ = Clock::now();
  return {saves, stopped_by};
}

}  // namespace tourmaline::run
