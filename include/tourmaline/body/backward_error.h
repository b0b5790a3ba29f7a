#pragma once

#include <span>
#include <vector>

#include "tourmaline/body/operator.h"

namespace tourmaline::body {

/// max |r| / (max_i (|K| e)_i max |x| + max |b|) for r = b - K x with the K of a step, all scaled:
/// `scale` holds a factor for each unknown, 0 where it is not solved for. How far b and K must be
/// changed, relatively, for x to be exact.
template <int dim>
double backward_error(const Operator<dim> &op, double step, const std::vector<double> &scale,
                      std::span<const double> residual, std::span<const double> right_side,
                      std::span<const double> state);

}  // namespace tourmaline::body
