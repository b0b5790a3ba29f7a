#pragma once

#include <span>
#include <vector>

#include "solve/model.h"

namespace tourmaline::solve {

/// Where the initial state of a dynamic run is not in equilibrium with the loads at t = 0 although
/// no mass keeps it, it would jump in the first step, and with it the accelerations around. So
/// potentials, and displacements of nodes without mass, go to their equilibrium with all others
/// held; nodes that touch their foundation stay unless they would have to be drawn to it. Supports
/// and given potentials get their values at t = 0. All ranks call it.
template <int dim>
void settle(const Model<dim> &model, std::vector<double> &state);

/// The case's, by unknown; where displacements are prescribed, that of the prescribed motion.
template <int dim>
std::vector<double> initial_velocity(const Model<dim> &model);

/// M a = f - K u - C v of nodes with mass; where displacements are prescribed, that of the
/// prescribed motion. All ranks call it.
template <int dim>
std::vector<double> initial_acceleration(const Model<dim> &model, std::span<const double> state,
                                         std::span<const double> velocity);

}  // namespace tourmaline::solve
