#include "run/schedule.h"

#include <array>
#include <cmath>

#include "parallel/ranks.h"

namespace tourmaline::run {

namespace {

// Steps that the program chooses bring as many files as others do where each of so many parts of
// the time brings one.
bool begins_part(const casefile::TimeSteps &steps, int n, double end) {
  constexpr double parts = 50;
  const auto part = [&](int step) { return std::floor(parts * steps.at(step) / end * (1 + 1e-9)); };
  return n == 0 || part(n) > part(n - 1);
}

}  // namespace

bool writes_fields(const casefile::Case &asked, const casefile::TimeSteps &steps, int n) {
  if (!asked.output.fields)
    return false;
  if (!asked.output.every)
    return begins_part(steps, n, asked.time.end);
  return n % *asked.output.every == 0 || steps.at(n) == asked.time.end;
}

bool Schedule::is_due(int first, int last) const {
  if (interval_.steps > 0)
    return last / interval_.steps > (first - 1) / interval_.steps;
  const std::chrono::duration<double> passed = Clock::now() - last_;
  return interval_.seconds > 0 && passed.count() >= interval_.seconds;
}

// Signals may reach any rank; of the clocks the first rank's counts.
Schedule::Pause Schedule::after(int first, int last) {
  std::array<double, 2> wishes{parallel::is_first() && is_due(first, last) ? 1. : 0.,
                               static_cast<double>(signals_.received())};
  parallel::largest(wishes);
  const int stopped_by = static_cast<int>(wishes[1]);
  const bool saves = wishes[0] > 0 || stopped_by != 0;
  if (saves)
    last_ = Clock::now();
  return {saves, stopped_by};
}

}  // namespace tourmaline::run
