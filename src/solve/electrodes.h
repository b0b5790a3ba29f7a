#pragma once

#include <Eigen/Dense>
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

/// The initial charges, by the initial state and the loads at the time 0.
template <int dim>
Eigen::VectorXd initial_charges(const Model<dim> &model, std::span<const double> initial);

}  // namespace tourmaline::solve
