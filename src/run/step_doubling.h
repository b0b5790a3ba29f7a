#pragma once

#include <array>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "body/backward_error.h"
#include "output/checkpoint.h"
#include "run/evolution.h"
#include "run/step_ladder.h"

namespace tourmaline::run {

/// Steps whose sizes follow from `time.tolerance`. Two steps are taken, and one of twice their size
/// from the same state: as backward Euler errs with the square of the step, the two err by what the
/// fields at the end differ, at first order. They are accepted where that is at most the tolerance
/// times the largest change of the field since the start, in u, phi and theta each, and where the
/// contact status is the same either way, or else the time at which it changes is known to the
/// tolerance times that of the run.
template <int dim>
class StepDoubling {
 public:
  /// `model` and `evolution` outlive this, and are left without steps.
  StepDoubling(solve::Model<dim> &model, Evolution<dim> &evolution);

  /// Prepares the sizes of the first steps, with which the evolution is to be made ready. Behind
  /// the checkpoint, if there is one.
  void plan(const output::SavedNumbers *numbers);

  /// The two steps behind step n, the last one that counts. Throws as Evolution::take, where it
  /// fails with the shortest steps, too.
  std::array<TakenStep, 2> next(int n);
  bool is_at_end() const { return ladder_.is_at_end(); }

  int sizes() const { return static_cast<int>(sizes_.size()); }  ///< factorised so far
  int rejected() const { return rejected_; }                     ///< attempts
  int computed() const { return computed_; }                     ///< steps, of all attempts
  /// Of steps that err more than was allowed, as they could not be shorter; empty: there are none.
  std::string warning() const;

  void save(output::SavedNumbers &numbers) const;

 private:
  using Point = typename Evolution<dim>::Point;

  TakenStep take(int n, double size, double end, const Point *from);
  double error(const TakenStep &whole, const TakenStep &halves, double length);
  double field_error(const TakenStep &whole, const TakenStep &halves);
  bool status_differs(const TakenStep &whole, const TakenStep &halves) const;
  void see_rough(double error, int n);
  void restore(const output::SavedNumbers &numbers);

  solve::Model<dim> &model_;
  Evolution<dim> &evolution_;
  StepLadder ladder_;
  std::vector<double> initial_;  // state
  body::FieldSizes changes_{};   // the largest since then of u, phi, theta, scaled
  std::array<double, body::Fields<dim>::count> scale_;
  std::set<double> sizes_;  // [s]
  int rejected_ = 0, computed_ = 0;
  int rough_ = 0;           // pairs that err more than was allowed
  double first_rough_ = 0;  // where the first of them begins [s]
};

}  // namespace tourmaline::run
