#pragma once

#include <array>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "output/checkpoint.h"
#include "solve/balance_step.h"
#include "solve/boundary_book.h"
#include "solve/energy_works.h"
#include "solve/model.h"
#include "solve/passage.h"
#include "solve/route.h"

namespace tourmaline::solve {

/// The balances of a step: forces, charges, heat and energy, from reactions (residuals of the whole
/// operator at prescribed unknowns), loads and contact forces. The stored energy is
///
///     W = u.A u / 2 + phi.B phi / 2 + theta.H0 theta / 2 - phi.P theta,
///
/// and with backward differences over a step, d = x_n - x_(n-1), it obeys exactly
///
///     W_n - W_(n-1) + W(d) = work - dissipation
///
/// with the work of loads, charges and heats and what friction and conduction dissipate, where
/// W(d) >= 0 is what the Euler step loses (docs/theory.md). Every balance is reported with
/// its imbalance relative to the sum of the sizes of its terms.
template <int dim>
class Balance {
 public:
  using Columns = std::vector<std::pair<std::string, double>>;

  Balance(const Model<dim> &model, std::span<const double> initial);

  /// Of a dynamic run that begins: the initial state's inertia.
  void begin_motion(const RateRecord &rates) {
    forces_before_ = initial_forces(model_, before_, rates);
  }

  /// Columns of history.csv for the step that ends at `time` with `state`. `loads` is the
  /// right-hand side without history; of the outcome the forces at the contact are used.
  /// Products are computed cell by cell where the route is refined, and where round-off of the
  /// assembled ones may be what an imbalance shows.
  Columns step(double time, std::span<const double> loads, const StepOutcome &outcome,
               std::span<const double> state, bool is_refined);

  /// The imbalances of the last step as they are to be judged: a balance all of whose terms are
  /// round-off lacks nothing.
  const Columns &judged() const { return judged_; }

  /// The state that the last step ended in.
  const BalancedState<dim> &balanced() const { return before_; }

  /// Of the last step: the terms of these sums that stand at nodes.
  const std::vector<Passage> &passages() const { return passages_; }

  /// What the next step compares with, besides the state: that of the checkpoint is what the
  /// balance to be restored was made with.
  void save(output::SavedNumbers &numbers) const;
  void restore(const output::SavedNumbers &numbers);

 private:
  using Step = BalanceStep<dim>;

  Columns columns_of(const Step &step);
  void put_imbalance(const std::string &name, double value, double size, double round_off,
                     Columns &columns);
  void add_forces(const Step &step, Columns &columns);
  void find_forces(const Step &step);
  void add_moment(const Step &step, Columns &columns) const;
  /// With the electric right-hand side `charges` of the step's end, by electrode [C].
  Eigen::VectorXd charges_on_electrodes(const Step &step, std::span<const double> charges) const;
  std::vector<Passage> charges_held(const Step &step) const;
  void add_charges(const Step &step, Columns &columns);
  void add_electrodes(const Step &step, Columns &columns) const;
  // Of an electrode's resistor the voltage that the electrode is not at [V].
  double other_end(std::size_t electrode, const Eigen::VectorXd &voltages, double time) const;
  std::vector<Passage> heats_held(const Step &step) const;
  void add_heat(const Step &step, Columns &columns);
  void add_friction_heat(const Step &step, Columns &columns) const;
  void add_energy(const Step &step, Columns &columns);
  void put_energies(const Step &step, const EnergyWorks &works, double gained, double lost,
                    Columns &columns) const;
  void put_each_contact(const EnergyWorks &works, Columns &columns) const;
  // `works` are what each field takes from outside, with a minus, and gives.
  double lack_of_energy(const Step &step, double whole, const std::array<double, 3> &gained,
                        const std::array<double, 3> &lost,
                        const std::array<std::vector<double>, 3> &works) const;
  /// Whether the foundation is more than the paper's.
  bool has_foundation_columns() const {
    return model_.laws.has_moving_foundation() || model_.laws.has_normal_unknowns();
  }
  bool has_damping_columns() const {
    return model_.op.rate_forces() != nullptr && model_.op.rate_forces()->is_damped();
  }
  double smallest_heat() const;

  const Model<dim> &model_;
  std::vector<bool> is_prescribed_;    // by unknown
  std::vector<bool> can_open_;         // by node: of a contact that can; empty: none can
  BalancedState<dim> before_;          // of the step before
  EndForces forces_before_;            // likewise, in the dynamic regime
  Eigen::VectorXd electrode_charges_;  // of that state [C]
  double of_step_;                     // k that the following is made for [s]
  double smallest_heat_;               // [W]
  CoupledFields coupled_;
  BoundaryBook<dim> boundaries_;
  Columns judged_;
  std::vector<Passage> passages_;
};

}  // namespace tourmaline::solve
