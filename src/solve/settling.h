#pragma once

#include <vector>

#include "solve/foundation_circuits.h"
#include "solve/model.h"

namespace tourmaline::solve {

/// Where the initial state of a dynamic run is not in equilibrium with the loads at t = 0 although
/// no mass keeps it, it would jump in the first step, and with it the accelerations around. So
/// potentials, and displacements of nodes without mass or damping, go to their equilibrium with all
/// others held; nodes that touch their foundation stay unless they would have to be drawn to it.
/// Supports and given potentials get their values at t = 0. Electrodes and foundations whose
/// potential is not given float: they keep the charge that they have in the case's state, but for
/// what their capacitors bring at once, Q + Y V = j for a step of 0 (`Circuit`). `foundations` has
/// begun at the case's state, and goes on from the settled one. By a factorisation of what is free,
/// or iteratively without one. All ranks call it. Throws SolveError.
template <int dim>
void settle(const Model<dim> &model, bool iteratively, FoundationCircuits<dim> &foundations,
            std::vector<double> &state);

}  // namespace tourmaline::solve
