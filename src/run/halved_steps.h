#pragma once

#include <string>
#include <vector>

#include "output/checkpoint.h"
#include "run/evolution.h"

namespace tourmaline::run {

/// The steps that a case asks for. One whose contact is not found is taken in two halves, and these
/// in halves again if need be. That concerns laws that depend on the state; others have their
/// solution in steps of any size.
template <int dim>
class HalvedSteps {
 public:
  /// `model` and `evolution` outlive this. Behind the checkpoint, if there is one: its steps become
  /// the model's.
  HalvedSteps(solve::Model<dim> &model, Evolution<dim> &evolution,
              const output::SavedNumbers *numbers);

  /// Step n, of the size that its contact was found with. Throws as `Evolution::take`, where it
  /// fails with the shortest steps, too.
  TakenStep take(int n);
  bool is_at_end(int done) const { return done == model_.steps.count(); }
  int count() const { return static_cast<int>(halved_.size()); }  ///< of steps that were halved
  /// A warning of them; empty: there are none.
  std::string warning() const;

  void save(output::SavedNumbers &numbers) const;

 private:
  solve::Model<dim> &model_;
  Evolution<dim> &evolution_;
  const bool may_be_unsettled_;
  double shortest_;             // step [s]
  std::vector<double> halved_;  // numbers that they had then, one after the other
  double first_ = 0;            // where the first of them begins [s]
};

}  // namespace tourmaline::run
