#pragma once

#include <memory>

#include "solve/model.h"
#include "solve/route.h"

namespace tourmaline::solve {

/// The iterative route where the contact is bilateral and friction depends on nothing but the slip:
/// Newton's method on all unknowns of a step. Which points slip is an active set: a sticking point
/// whose force exceeds the bound is let go, a slipping point whose slip turns against its direction
/// is caught. `model` outlives the route.
template <int dim>
std::unique_ptr<Route> active_set_route(const Model<dim> &model);

}  // namespace tourmaline::solve
