#pragma once

#include <string>
#include <utility>
#include <vector>

#include "body/discretisation.h"
#include "tourmaline/case/formula.h"

namespace tourmaline::solve {

/// The integral of `factor` times `coefficient` times the shape function of each node on the
/// boundaries; on all ranks the whole.
template <int dim>
std::vector<std::pair<body::Node, double>> exchange_weights(
    const body::Discretisation<dim> &body, const std::vector<std::string> &boundaries,
    const casefile::Formula &coefficient, double factor);

}  // namespace tourmaline::solve
