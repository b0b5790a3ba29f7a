#pragma once

#include <cstdint>
#include <vector>

#include "output/checkpoint.h"

namespace tourmaline::run {

/// Sizes of steps that come in pairs, by the errors of those before. Between two times that no step
/// may pass (the ends of the run and the bends of its loads), a pair takes a power of two times a
/// unit that all these stretches are multiples of, where there is one: so that few sizes come, and
/// come again.
class StepLadder {
 public:
  /// A run to `end` with steps of at most `longest`, and pairs of at most twice that, none across
  /// one of the ascending times `bends` inside the run [s].
  StepLadder(double end, double longest, const std::vector<double> &bends);

  struct Pair {
    double size;         ///< of each of the two steps [s]
    double middle, end;  ///< the times at which they end [s]
  };
  /// The pair to try; not at the end.
  Pair pair() const;
  bool is_at_end() const { return stretch_ == stretches_.size(); }

  /// The pair has been taken. `error` is that of its two steps over what is allowed; it falls with
  /// the square of their size.
  void accept(double error);
  /// The pair is to be tried again, shorter. Only where it `can_shrink`.
  void reject(double error);
  bool can_shrink() const;

  void save(output::SavedNumbers &numbers) const;
  void restore(const output::SavedNumbers &numbers);

 private:
  // Places in a stretch, and lengths of pairs, are counted in ticks.
  using Ticks = std::int64_t;
  struct Stretch {
    double begin, end, tick;  // [s]
    Ticks length;
  };
  const Stretch &stretch() const { return stretches_[stretch_]; }
  Ticks length() const;
  double time(Ticks place) const;

  std::vector<Stretch> stretches_;
  double longest_;           // pair [s]
  double wanted_;            // pair [s]
  std::size_t stretch_ = 0;  // where the next pair begins
  Ticks place_ = 0;
};

}  // namespace tourmaline::run
