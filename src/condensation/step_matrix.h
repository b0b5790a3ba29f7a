#pragma once

#include <vector>

#include "body/operator.h"
#include "condensation/grouped_matrix.h"

namespace tourmaline::condensation {

/// The operator of a step in the variables that are solved for, as groups: what is not kept of each
/// node, in the order `node_at`, then what is kept of each. `unknown_of` has the body's unknown of
/// each variable, `scale` a factor for its row and column; both and the operator outlive the
/// matrix.
template <int dim>
GroupedMatrix step_matrix(const body::Operator<dim> &op, double step,
                          const std::vector<body::Node> &node_at,
                          const std::vector<std::size_t> &unknown_of,
                          const std::vector<double> &scale, const std::vector<bool> &is_kept);

}  // namespace tourmaline::condensation
