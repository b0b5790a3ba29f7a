#pragma once

#include <string>
#include <vector>

#include "solve/model.h"

namespace tourmaline::run {

/// Whether linear cells are too stiff for how the body is bent in that state, the most strained one
/// of a run: a warning, empty when all is well. There is none of degree 2 and of incompatible
/// modes. All ranks ask together.
template <int dim>
std::string locking_warning(const solve::Model<dim> &model, const std::vector<double> &state);

/// What the mesh alone tells: of a slender body with linear cells how many times too stiff it would
/// be if it were bent. Empty when the cells do or when that cannot be told. For `tourmaline check`.
std::string slender_warning(const casefile::Case &asked);

}  // namespace tourmaline::run
