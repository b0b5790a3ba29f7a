#pragma once

#include "random.h"
#include "sample.h"

namespace tourmaline::verified {

/// An orthogonal matrix that takes the case's supports to ones that a case file can say: where
/// components are free, axes go to axes.
Eigen::MatrixXd random_turn(const Sample &sample, bool mirrors, Random &random);
/// Mesh, crystals, loads and supports turned, or mirrored where the determinant is -1.
Sample turned(Sample sample, const Eigen::MatrixXd &turn);

Units random_units(Random &random);
Sample in_units(Sample sample, const Units &units);

/// Vertices, cells, facets and each cell's own vertices in another order.
Sample renumbered(Sample sample, Random &random);

/// `a` times the loads of the one and `b` times those of the other.
Sample superposed(const Sample &one, double a, const Sample &other, double b);

}  // namespace tourmaline::verified
