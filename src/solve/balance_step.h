#pragma once

#include <Eigen/Dense>
#include <array>
#include <span>
#include <vector>

#include "body/operator.h"
#include "solve/model.h"
#include "solve/route.h"

namespace tourmaline::solve {

/// A state of the body as its balances see it. Vectors have an entry for each unknown.
template <int dim>
struct BalancedState {
  std::vector<double> unknowns;  ///< SI
  body::FieldProducts products;  ///< of the storage operator
  std::vector<double> charges;   ///< electric right-hand side, reactions included [C]
  body::Energies stored;         ///< [J]
  bool by_cells = false;         ///< products and energies are sums of the cells'
};

/// Of the sums in a balance, what round-off may have made of them.
struct BalanceRoundOff {
  double force = 0;                ///< [N]
  double charge = 0;               ///< [C]
  double heat = 0;                 ///< [W]
  std::array<double, 3> energy{};  ///< by field [J]
};

/// What acts on u at the end of a step, by unknown [N]: the next one's balance of energy knows the
/// forces at both of its ends.
struct EndForces {
  std::vector<double> loads, contact, friction, rates;
};

/// The numbers of one step that its balances share.
///
/// In the dynamic regime equilibrium at both ends of a step, in their mean and times d, is the
/// balance of energy: forces, potentials and temperatures that work are means (`working`), and the
/// Euler step's W(d) is not lost. What laws of friction and conduction by the end's values
/// dissipate is told by these, and the difference is the scheme's (docs/theory.md).
template <int dim>
struct BalanceStep {
  double time = 0;
  std::span<const double> loads;  ///< by unknown, without history
  /// by unknown, with what capacitors at the contact hold; empty: there are none
  std::vector<double> with_capacitors;
  BalancedState<dim> before, now;
  std::vector<double> conducted;       ///< by node [W]
  std::vector<double> heat_supplied;   ///< by node, at prescribed temperatures [W]
  Eigen::VectorXd friction_heat;       ///< by interface node, into the body [W]; empty: none
  double backward_error = 0;           ///< of the body's equations, beyond round-off
  Eigen::VectorXd leaked;              ///< by interface node, before this step [C]; empty: none
  std::vector<double> heat_crossed;    ///< by node, at the contact by its state, inwards [W]
  std::vector<double> charge_crossed;  ///< the same of charge, outwards [C]
  std::vector<double> contact;         ///< by unknown [N]
  std::vector<double> friction;        ///< the part of it that opposes the slip [N]
  std::vector<double> carried;  ///< by unknown: how the foundation has moved [m]; empty: it rests
  RateRecord rates;             ///< what resists rates of u
  const EndForces *earlier = nullptr;  ///< of the step before, in the dynamic regime; else null
  BalanceRoundOff round_off;

  /// What a potential's row would have without reaction and what crosses by the contact's state.
  std::span<const double> known_charges() const {
    return with_capacitors.empty() ? loads : std::span<const double>(with_capacitors);
  }
  bool is_dynamic() const { return earlier != nullptr; }
  double rate_force(std::size_t i) const { return rates.forces.empty() ? 0 : rates.forces[i]; }
  /// What holds a prescribed displacement and the contact's force together [N].
  double holding(std::size_t i) const { return now.products.sum(i) + rate_force(i); }
  /// What holds a prescribed displacement beside load and contact [N].
  double reaction(std::size_t i) const { return holding(i) - loads[i] - contact[i]; }
  /// What moves a displacement beside the contact: what holds a prescribed one, else the load [N].
  double working_load(std::size_t i, bool is_prescribed) const {
    const double end = is_prescribed ? holding(i) - contact[i] : loads[i];
    if (!is_dynamic())
      return end;
    return (end + (is_prescribed ? before.products.sum(i) + earlier->rates[i] - earlier->contact[i]
                                 : earlier->loads[i])) /
           2;
  }
  double working_contact(std::size_t i) const {
    return is_dynamic() ? (contact[i] + earlier->contact[i]) / 2 : contact[i];
  }
  double working_friction(std::size_t i) const {
    return is_dynamic() ? (friction[i] + earlier->friction[i]) / 2 : friction[i];
  }
  /// A potential or temperature.
  double working(std::size_t i) const {
    return is_dynamic() ? (now.unknowns[i] + before.unknowns[i]) / 2 : now.unknowns[i];
  }
  double change(std::size_t i) const { return now.unknowns[i] - before.unknowns[i]; }
  double carried_by(std::size_t i) const { return carried.empty() ? 0 : carried[i]; }
  double product_change(int field, std::size_t i) const {
    return now.products.of[field][i] - before.products.of[field][i];
  }
  /// W(d), what the Euler step loses (docs/theory.md, section 8). All ranks together, as below.
  body::Energies energy_of_change(const body::NodeSharing &sharing) const;
  /// W_n - W_(n-1) as d . K (x_n + x_(n-1)) / 2: the round-off of a difference of the two would be
  /// that of all that is stored, and of what cells of a thin body carry around.
  body::Energies change_of_energy(const body::NodeSharing &sharing) const;
};

/// Of u, phi and theta. The coupling's part is that of phi, which theta is coupled to where there
/// is any.
std::array<double, 3> by_field(const body::Energies &energy);

/// Which fields (u, phi, theta) have anything to do with one another, over others as well.
using CoupledFields = std::array<std::array<bool, 3>, 3>;
template <int dim>
CoupledFields coupled_fields(const Model<dim> &model);

/// The state that a run starts from.
template <int dim>
BalancedState<dim> initial_balance(const Model<dim> &model, std::span<const double> initial);

/// The step from `before` to the state `now` at the end of it, `time`. Products with the operator
/// are taken cell by cell where the assembled ones are not sure enough, those of `before` as well.
template <int dim>
BalanceStep<dim> balance_step(const Model<dim> &model, const std::vector<bool> &is_prescribed,
                              BalancedState<dim> before, const EndForces *earlier, double time,
                              std::span<const double> loads, const StepOutcome &outcome,
                              std::span<const double> now, bool cell_by_cell);

/// The forces that a dynamic run starts from: what the initial state lacks of equilibrium at
/// contact nodes, the contact bears.
template <int dim>
EndForces initial_forces(const Model<dim> &model, const BalancedState<dim> &initial,
                         const RateRecord &rates);

/// A solution is uncertain by the round-off, or the backward error, of the largest scaled unknown
/// of the fields that are coupled: that is what a field of which there is nothing consists of;
/// fields that consist of what the solver let through from others may lack anything. Forces,
/// charges and heats have |K| times that; energies cell by cell have its square, as K annihilates
/// what changes none. That much a sum may lack.
template <int dim>
BalanceRoundOff round_off_of(const Model<dim> &model, const CoupledFields &coupled,
                             const BalanceStep<dim> &step);

}  // namespace tourmaline::solve
