#pragma once

#include <memory>
#include <span>
#include <vector>

#include "contact/friction_bound.h"
#include "output/checkpoint.h"
#include "solve/contact_step.h"
#include "solve/held_bounds.h"
#include "solve/model.h"
#include "solve/route.h"
#include "solve/saddle_system.h"

namespace tourmaline::solve {

/// The contact of a saddle point: the laws that a step has at the points of its multipliers, and
/// what a solution x of it says of the contact nodes. `StepData` is the step's, its `rest` and its
/// laws those that are made here.
template <int dim>
class SaddleContact {
 public:
  /// Both outlive this. Throws CaseError for nodes whose laws need a normal displacement that other
  /// conditions tilt.
  SaddleContact(const Model<dim> &model, const SaddleSystem<dim> &system);

  /// A step from the state `before`, which outlives it.
  void begin_step(double time, std::span<const double> before) {
    time_ = time;
    step_.begin(time, before);
  }
  /// A state in which the contact nodes just touch the foundation.
  std::vector<double> rest() const;
  /// `before`: carried along with the foundation; `state` holds the prescribed values.
  std::vector<contact::AugmentedLagrangian> laws(std::span<const double> before,
                                                 std::span<const double> state,
                                                 std::span<const double> rest) const;

  /// Friction bounds that follow the pressure, by point; nothing where they do not.
  std::vector<std::shared_ptr<const contact::FrictionBound>> bounds() const;
  /// What they depend on: as x, the end of the last step, leaves it, and as x has it now.
  std::vector<HeldBounds::State> first_states(const SaddlePoint &x) const;
  std::vector<HeldBounds::State> states(const StepData &data, const SaddlePoint &x) const;
  /// Points that are closed though round-off may say that they are open; none: empty. Until this
  /// is said anew.
  void see_touching(std::vector<bool> just_touches) { just_touches_ = std::move(just_touches); }
  /// What crosses the contact depends on, by point.
  std::vector<contact::ContactState> states_for_exchange(const StepData &data,
                                                         const SaddlePoint &x) const;

  /// A node slips when the multiplier's point does: itself, or any of the facets around it.
  std::vector<ContactStatus> status(const StepData &data, const SaddlePoint &x) const;
  /// At the interface, `dim` of each node [N]: those of the contact and, where displacements are
  /// prescribed, of what prescribes them.
  Eigen::VectorXd holding_forces(const StepData &data, const SaddlePoint &x) const;
  /// A node that the law or a condition holds is put exactly there, not where the round-off of the
  /// last increment has left it. For nodal multipliers, whose points are the interface nodes.
  void settle(const StepData &data, const std::vector<ContactStatus> &status, SaddlePoint &x) const;
  /// Friction is the law's, the foundation has what is normal, supports have the rest.
  void share_forces(const StepData &data, const SaddlePoint &x, StepOutcome &outcome) const;
  /// Keeps what the next step's friction depends on.
  void end_step(const StepData &data, const SaddlePoint &x, StepOutcome &outcome);
  /// The step that has ended is to be taken again.
  void take_back() { step_.take_back(); }

  void save(output::SavedNumbers &numbers) const { step_.save(numbers); }
  void restore(const output::SavedNumbers &numbers) { step_.restore(numbers); }

 private:
  using Point = contact::MultiplierPoint<dim>;

  bool touches(const StepData &data, const SaddlePoint &x, std::size_t p) const;
  double supported_pressure(const SaddlePoint &x, std::size_t p,
                            const Eigen::VectorXd &holding) const;
  double penetration(const SaddlePoint &x, std::size_t node) const {
    return step_.penetration(node, step_.displacement(x.body, node));
  }
  contact::Tangent whole_friction(const StepData &data, const SaddlePoint &x, std::size_t p,
                                  const Eigen::VectorXd &holding) const;
  std::size_t interface_index(body::Node node) const;

  const Model<dim> &model_;
  const SaddleSystem<dim> &system_;
  double area_ = 0;  // of the contact boundary [m^(dim-1)]
  ContactStep<dim> step_;
  // Of the step at hand:
  double time_ = 0;
  std::vector<bool> just_touches_;
};

}  // namespace tourmaline::solve
