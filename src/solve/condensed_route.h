#pragma once

#include <memory>

#include "solve/model.h"
#include "solve/route.h"

namespace tourmaline::solve {

/// The program's own route: one factorisation for the run; in a step one forward substitution, the
/// contact problem on the condensed stiffness, one backward substitution.
template <int dim>
std::unique_ptr<Route> condensed_route(const Model<dim> &model);

}  // namespace tourmaline::solve
