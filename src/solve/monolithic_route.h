#pragma once

#include <memory>

#include "solve/model.h"
#include "solve/route.h"

namespace tourmaline::solve {

/// The paper's route, section 3.2: Newton's method (43), (44) on all unknowns and multipliers of
/// the augmented Lagrangian system (37), whose tangent is assembled and factorised in every
/// iteration. Where this iteration does not settle, steps of the method of multipliers on the same
/// augmented Lagrangian, which with exact minimisations converge from any start, bring it near
/// enough (docs/monolithic.md).
///
/// Throws CaseError where the multipliers asked for are not determined.
template <int dim>
std::unique_ptr<Route> monolithic_route(const Model<dim> &model);

}  // namespace tourmaline::solve
