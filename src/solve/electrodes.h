#pragma once

#include <Eigen/Dense>
#include <optional>
#include <span>
#include <vector>

#include "solve/model.h"

namespace tourmaline::solve {

/// Charge on each electrode of the model, -integral of D.nu [C]: the consistent reaction, what the
/// electric rows of `products` = K x lack beside `loads`, summed over the electrode's nodes. It is
/// the charge whose work with the voltage is exactly the electric work of the step.
template <int dim>
Eigen::VectorXd electrode_charges(const Model<dim> &model, std::span<const double> products,
                                  std::span<const double> loads);

/// Voltage of each electrode [V]: the potential at its nodes. Throws CaseError where they differ,
/// which only an initial state can.
template <int dim>
Eigen::VectorXd electrode_voltages(const Model<dim> &model, std::span<const double> state);

/// The charges of the case's initial state, in which there is no load yet: it is switched on at
/// t = 0, as voltages are. Counted at the electrodes' nodes without the potential that belongs to
/// it, a volume charge would leave them a charge by the width of a cell. The state of another run
/// is one in which they had been on: its loads are those at t = 0; what electrodes keep is what
/// they had there, whatever the mesh.
template <int dim>
Eigen::VectorXd initial_charges(const Model<dim> &model, std::span<const double> initial);

/// Those of a state that is in equilibrium with the loads at t = 0.
template <int dim>
Eigen::VectorXd settled_charges(const Model<dim> &model, std::span<const double> settled);

/// The time at which the formulas of circuits' sources say what these were before the start [s]:
/// t = 0 where the state is another run's, whose sources had come to there; nothing: they were at
/// 0 V.
template <int dim>
std::optional<double> sources_before_start(const Model<dim> &model);

/// Since when the sources of circuits have been what their formulas say, as the step that ends at
/// `time` sees it [s]; nothing: they are switched on in it, since the first step begins at the
/// case's initial state. A dynamic run begins at one that is settled.
template <int dim>
std::optional<double> sources_before(const Model<dim> &model, double time);

}  // namespace tourmaline::solve
