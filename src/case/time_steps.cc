#include "case/time_steps.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "tourmaline/case/case.h"

namespace tourmaline::casefile {

namespace {

// Of (end - begin) / steps, as the ends are rounded.
double round_off(double end, int steps) {
  return 8 * std::numeric_limits<double>::epsilon() * end / steps;
}

}  // namespace

TimeSteps::TimeSteps(const TimeCase &asked) {
  std::vector<IntervalCase> given = asked.intervals;
  if (given.empty())
    given.push_back({asked.end, asked.steps});
  double begin = 0;
  int last = 0;
  for (const IntervalCase &interval : given) {
    double size = (interval.until - begin) / interval.steps;
    for (const Interval &earlier : intervals_)
      if (std::abs(earlier.size - size) <=
          std::max(round_off(interval.until, interval.steps),
                   round_off(earlier.end, earlier.last - earlier.first + 1))) {
        size = earlier.size;
        break;
      }
    intervals_.push_back({begin, interval.until, last + 1, last + interval.steps, size});
    begin = interval.until;
    last += interval.steps;
  }
}

const TimeSteps::Interval &TimeSteps::of(int n) const {
  const auto found =
      std::partition_point(intervals_.begin(), intervals_.end(),
                           [n](const Interval &interval) { return interval.last < n; });
  return found == intervals_.end() ? intervals_.back() : *found;
}

double TimeSteps::at(int n) const {
  if (n == 0)
    return 0;
  const Interval &interval = of(n);
  if (n == interval.last)  // to the last bit: formulas need not be there beyond it
    return interval.end;
  return interval.begin + (interval.end - interval.begin) * (n - interval.first + 1) /
                              (interval.last - interval.first + 1);
}

int TimeSteps::number(double time) const {
  const auto found =
      std::partition_point(intervals_.begin(), intervals_.end(),
                           [time](const Interval &interval) { return interval.end < time; });
  if (found == intervals_.end())
    return count();
  return found->first - 1 + static_cast<int>(std::lround((time - found->begin) / found->size));
}

int TimeSteps::sizes(int n) const {
  std::set<double> sizes;
  for (const Interval &interval : intervals_)
    if (interval.first <= n)
      sizes.insert(interval.size);
  return static_cast<int>(sizes.size());
}

void TimeSteps::keep(int n) {
  while (!intervals_.empty() && intervals_.back().last > n)
    intervals_.pop_back();
}

void TimeSteps::append(double size, double end) {
  const int last = intervals_.empty() ? 0 : count();
  intervals_.push_back({last > 0 ? at(last) : 0, end, last + 1, last + 1, size});
}

void TimeSteps::halve(int n) {
  const Interval whole = of(n);
  const double begin = at(n - 1), end = at(n);
  std::vector<Interval> parts;
  if (whole.first < n)
    parts.push_back({whole.begin, begin, whole.first, n - 1, whole.size});
  parts.push_back({begin, end, n, n + 1, whole.size / 2});
  if (n < whole.last)
    parts.push_back({end, whole.end, n + 2, whole.last + 1, whole.size});
  auto at_whole = std::partition_point(intervals_.begin(), intervals_.end(),
                                       [n](const Interval &interval) { return interval.last < n; });
  at_whole = intervals_.erase(at_whole);
  for (auto later = at_whole; later != intervals_.end(); ++later) {
    ++later->first;
    ++later->last;
  }
  intervals_.insert(at_whole, parts.begin(), parts.end());
}

}  // namespace tourmaline::casefile
