#pragma once

#include <array>
#include <span>
#include <vector>

#include "body/operator.h"

namespace tourmaline::body {

/// max |r| / (max_i (|K| e)_i max |x| + max |b|) for r = b - K x with the K of a step, all scaled:
/// `scale` holds a factor for each unknown, 0 where it is not solved for. How far b and K must be
/// changed, relatively, for x to be exact.
template <int dim>
double backward_error(const Operator<dim> &op, double step, const std::vector<double> &scale,
                      std::span<const double> residual, std::span<const double> right_side,
                      std::span<const double> state);

/// The largest scaled entries by field: u, phi, theta.
using FieldSizes = std::array<double, 3>;

/// `scale` holds a factor for each component of a node. All ranks together.
template <int dim>
FieldSizes field_sizes(const NodeSharing &sharing, std::span<const double> state,
                       std::span<const double> scale);

/// Size of a change over that of what changed, the worst field's. A field of which there is next
/// to nothing (a millionth of the largest, so 1e-12 of its energy) is measured by that millionth.
/// Infinite where a number is not one.
double relative_size(const FieldSizes &change, const FieldSizes &whole);
template <int dim>
double relative_size(const NodeSharing &sharing, std::span<const double> change,
                     std::span<const double> state, std::span<const double> scale) {
  return relative_size(field_sizes<dim>(sharing, change, scale),
                       field_sizes<dim>(sharing, state, scale));
}

}  // namespace tourmaline::body
