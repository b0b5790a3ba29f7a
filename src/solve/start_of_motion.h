#pragma once

#include <span>
#include <vector>

#include "solve/model.h"

namespace tourmaline::solve {

/// What a state leaves of the equations at t = 0, by unknown: loads - K x, without rates, without
/// history and without what crosses the contact by its state. All ranks call it.
template <int dim>
std::vector<double> left_at_start(const Model<dim> &model, std::span<const double> state);

/// The case's, by unknown; where displacements are prescribed, that of the prescribed motion.
template <int dim>
std::vector<double> initial_velocity(const Model<dim> &model);

/// M a = f - K u - C v of nodes with mass; where displacements are prescribed, that of the
/// prescribed motion. All ranks call it.
template <int dim>
std::vector<double> initial_acceleration(const Model<dim> &model, std::span<const double> state,
                                         std::span<const double> velocity);

}  // namespace tourmaline::solve
