#pragma once

#include <Eigen/Dense>
#include <optional>
#include <span>
#include <vector>

#include "output/checkpoint.h"
#include "solve/model.h"
#include "solve/route.h"

namespace tourmaline::solve {

/// What leaks that do not depend on the contact's state let out of the body in a step of the
/// model's size with this state, integrated against the shape functions, by node [C]; by the
/// foundation's potential at `time`, nothing: at 0 V. On all ranks.
template <int dim>
std::vector<double> leaking(const Model<dim> &model, std::optional<double> time,
                            std::span<const double> state);

/// The charge that has crossed leaks which do not depend on the contact's state, d(D.nu)/dt = c
/// (phi - phi_f), over all steps: what goes on crossing in later ones. That of the step at hand is
/// in the operator, c k as a capacitor. By interface node; where there are none, nothing.
template <int dim>
class LeakedCharge {
 public:
  /// `model` outlives this.
  explicit LeakedCharge(const Model<dim> &model);

  /// To the electric rows of a step's right-hand side.
  void add_to(std::vector<double> &right_side) const;
  void describe(StepOutcome &outcome) const;
  /// The step that ends at `time` with `state` is done. On all ranks.
  void end_step(double time, std::span<const double> state);

  void save(output::SavedNumbers &numbers) const;
  void restore(const output::SavedNumbers &numbers);

 private:
  const Model<dim> &model_;
  bool leaks_ = false;
  Eigen::VectorXd charge_;  // integrated against the shape functions [C]
  Eigen::VectorXd flux_;    // D.nu at the nodes [C/m^2]
};

}  // namespace tourmaline::solve
