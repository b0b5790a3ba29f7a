#pragma once

#include <cstddef>
#include <vector>

namespace tourmaline::casefile {

struct TimeCase;

/// The steps of a case, numbered from 1: of one size, or of one size in each interval. Sizes of
/// intervals that differ by round-off alone are one size, so that what is factorised for it serves
/// all of them. Where the program chooses the steps, those that were asked for only stand there
/// until it does.
class TimeSteps {
 public:
  explicit TimeSteps(const TimeCase &asked);

  int count() const { return intervals_.back().last; }
  /// The time at which step n ends [s]; 0 is the start.
  double at(int n) const;
  /// k of step n [s], from n = 1 on.
  double size(int n) const { return of(n).size; }
  /// The time at which the step began that ends at `time`.
  double before(double time) const { return at(number(time) - 1); }
  /// Of the step that ends at `time`.
  int number(double time) const;
  /// How many sizes the steps 1 to n have.
  int sizes(int n) const;

  /// Of steps that are chosen as they come: only the first n are left; and another one follows
  /// them, of that size, which ends at `end`.
  void keep(int n);
  void append(double size, double end);
  /// Step n is taken in two of half its size; those behind it have higher numbers then.
  void halve(int n);

 private:
  struct Interval {
    double begin, end;  // [s]
    int first, last;    // steps
    double size;        // [s]
  };
  const Interval &of(int n) const;

  std::vector<Interval> intervals_;
};

}  // namespace tourmaline::casefile
