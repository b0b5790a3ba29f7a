#pragma once

#include <memory>

#include "solve/model.h"
#include "solve/route.h"

namespace tourmaline::solve {

/// The route for bodies too large for a factorisation: Newton's method on all unknowns of a step,
/// each linear system solved by preconditioned Krylov iteration (`krylov::BodySystem`). Which
/// points slip is an active set: a sticking point whose force exceeds the bound is let go, a
/// slipping point whose slip turns against its direction is caught. `model` outlives the route.
template <int dim>
std::unique_ptr<Route> iterative_route(const Model<dim> &model);

}  // namespace tourmaline::solve
