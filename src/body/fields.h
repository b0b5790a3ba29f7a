#pragma once

#include <algorithm>
#include <string>

#include "body/discretisation.h"

namespace tourmaline::body {

/// Unknowns of one node: u_1 ... u_dim, phi, theta, in this order.
template <int dim>
struct Fields {
  static constexpr int potential = dim, temperature = dim + 1, count = dim + 2;
};

/// Index of an unknown in vectors over the body, `node * (dim + 2) + component`.
template <int dim>
constexpr std::size_t unknown(Node node, int component) {
  return std::size_t{node} * Fields<dim>::count + component;
}

/// The field that an unknown, or a component of a node, belongs to: 0 displacement, 1 potential,
/// 2 temperature.
template <int dim>
constexpr int field_of(std::size_t unknown) {
  return std::max(0, static_cast<int>(unknown % Fields<dim>::count) - dim + 1);
}

/// What tables call a component of a node: u_x, ..., potential, temperature.
template <int dim>
std::string column_of(int component) {
  if (component < dim)
    return std::string("u_") + "xyz"[component];
  return component == Fields<dim>::potential ? "potential" : "temperature";
}

}  // namespace tourmaline::body
