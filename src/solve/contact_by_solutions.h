#pragma once

#include <memory>

#include "solve/model.h"
#include "solve/route.h"

namespace tourmaline::solve {

/// The iterative route where what happens along the normal decides something: contact that may
/// open, friction that depends on the pressure, heat and charge that cross by the state. The matrix
/// of the contact's unknowns is known by solutions of the body's equations (`ContactBody`).
template <int dim>
std::unique_ptr<Route> contact_by_solutions(const Model<dim> &model);

}  // namespace tourmaline::solve
