#pragma once

#include <span>
#include <string>
#include <vector>

#include "case/holding.h"
#include "output/checkpoint.h"
#include "solve/model.h"
#include "solve/rigid_work.h"
#include "solve/route.h"

namespace tourmaline::run {

/// Watches over bodies that nothing but contact keeps from a rigid motion. Where the contact opens
/// and no load works on that motion either, the equations hold wherever the body stands.
template <int dim>
class Adrift {
 public:
  /// `model` outlives this.
  explicit Adrift(const solve::Model<dim> &model);

  /// Of step n, which ends in `state` under `loads`, by unknown. Throws SolveError where they work
  /// on a motion that nothing resists, or contact forces do not balance them along one that nothing
  /// else resists, and where that state is farther away than the contact can have held it, or so
  /// far that neither deformation nor forces have digits left.
  void step(int n, const solve::StepOutcome &outcome, std::span<const double> loads,
            std::span<const double> state);
  /// Empty where the body was held in every step.
  std::string warning() const;

  void save(output::SavedNumbers &numbers) const;
  void restore(const output::SavedNumbers &numbers);

 private:
  std::vector<casefile::Support> supports(const solve::StepOutcome &outcome) const;
  void require_held(double time, const std::vector<casefile::Support> &held,
                    std::span<const double> loads) const;
  void require_balanced(int n, const solve::StepOutcome &outcome, std::span<const double> loads,
                        double displacement) const;
  void require_near(int n, const solve::StepOutcome &outcome, bool is_held,
                    double displacement) const;
  double largest_displacement(std::span<const double> state) const;

  const solve::Model<dim> &model_;
  std::string left_to_contact_;  // the motions, as a phrase
  int steps_ = 0, first_ = 0;    // in which it was not held
};

}  // namespace tourmaline::run
