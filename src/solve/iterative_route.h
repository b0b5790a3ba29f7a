#pragma once

#include <memory>

#include "solve/model.h"
#include "solve/route.h"

namespace tourmaline::solve {

/// The route for bodies too large for a factorisation: each linear system of a step is solved by
/// preconditioned Krylov iteration (`krylov::BodySystem`) and, where round-off decides, refined; a
/// step starts where the last one goes on to. `model` outlives the route.
template <int dim>
std::unique_ptr<Route> iterative_route(const Model<dim> &model);

}  // namespace tourmaline::solve
