#pragma once

#include <span>
#include <vector>

#include "body/fields.h"

namespace tourmaline::body {

/// A place of the body, where a field is the sum of its values at `nodes` times `weights`: the
/// shape functions of the cell that the place lies in. Where nodes are shared out to the ranks only
/// one rank has them, and without nodes the value is 0: the place's is the sum over the ranks.
struct Interpolation {
  Vector3 place{};  ///< [m]
  std::vector<Node> nodes;
  std::vector<double> weights;
  double distance = 0;  ///< from the place that was asked for [m]; 0: it is that one

  /// Component c of the unknowns there.
  template <int dim>
  double value(std::span<const double> state, int c) const {
    double sum = 0;
    for (std::size_t a = 0; a < nodes.size(); ++a)
      sum += weights[a] * state[unknown<dim>(nodes[a], c)];
    return sum;
  }
};

/// The places of the body that are nearest to these [m]. Within 1e-9 of the
/// body's size a place is on its boundary; the nearest place of one that lies farther outside has
/// no nodes.
template <int dim>
std::vector<Interpolation> nearest_places(const Discretisation<dim> &body,
                                          const std::vector<Vector3> &places);

}  // namespace tourmaline::body
