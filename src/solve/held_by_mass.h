#pragma once

#include "solve/model.h"

namespace tourmaline::solve {

/// Throws CaseError where contact nodes have given their mass to so few others that these resist no
/// rotation of the body, and neither supports nor contact that stays closed prevent it: equations
/// with inertia would not say how it turns.
template <int dim>
void require_mass_that_holds(const Model<dim> &model);

}  // namespace tourmaline::solve
