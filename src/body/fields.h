#pragma once

#include "body/discretisation.h"

namespace tourmaline::body {

/// Unknowns of one node: u_1 ... u_dim, phi, theta, in this order.
template <int dim>
struct Fields {
  static constexpr int potential = dim, temperature = dim + 1, count = dim + 2;
};

/// Index of an unknown in vectors over the whole body, `node * (dim + 2) + component`.
template <int dim>
constexpr std::size_t unknown(Node node, int component) {
  return std::size_t{node} * Fields<dim>::count + component;
}

}  // namespace tourmaline::body
