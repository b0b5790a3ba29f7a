#pragma once

#include <span>
#include <vector>

#include "solve/model.h"

namespace tourmaline::solve {

/// What a state leaves of the equations at t = 0, by unknown: loads - K x, without rates, without
/// history and without what crosses the contact by its state. All ranks call it.
template <int dim>
std::vector<double> left_at_start(const Model<dim> &model, std::span<const double> state);

struct PrescribedRates {
  double velocity = 0, acceleration = 0;  ///< [m/s, m/s^2]
};

/// Of a prescribed displacement at time t [s], by differences of its formula over the step at hand,
/// of order 2: central ones, one-sided at the ends of the run, never outside of it.
template <int dim>
PrescribedRates prescribed_rates(const Model<dim> &model, const body::Prescribed &p, double time);

/// The case's, by unknown; where displacements are prescribed, that of the prescribed motion. All
/// ranks call it.
template <int dim>
std::vector<double> initial_velocity(const Model<dim> &model);

/// M a = f - K u - C v of nodes with mass; where displacements are prescribed, that of the
/// prescribed motion. All ranks call it.
template <int dim>
std::vector<double> initial_acceleration(const Model<dim> &model, std::span<const double> state,
                                         std::span<const double> velocity);

}  // namespace tourmaline::solve
