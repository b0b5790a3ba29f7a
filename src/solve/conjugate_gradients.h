#pragma once

#include <functional>
#include <span>
#include <vector>

#include "body/node_sharing.h"

namespace tourmaline::solve {

/// Some unknowns of a body while all others are held, with a symmetric matrix A that is positive
/// definite in these and whose products are cheap: mass, conduction. Vectors are by unknown of this
/// rank.
struct FreeUnknowns {
  const body::NodeSharing &sharing;
  std::vector<bool> is_free;
  std::vector<double> diagonal;  ///< of A, at least where they are free
  /// A x of an x that is zero elsewhere. All ranks together.
  std::function<std::vector<double>(const std::vector<double> &)> product;

  /// The sum of r_i^2 / A_ii. All ranks together.
  double size_of(std::span<const double> r) const;
};

/// Conjugate gradients with the diagonal of A: changes the free entries of x until `residual`,
/// b - A x as it begins, has a size of at most `enough`. False where that takes more than `most`
/// iterations. All ranks together.
bool conjugate_gradients(const FreeUnknowns &of, std::vector<double> residual, double enough,
                         std::size_t most, std::vector<double> &x);

}  // namespace tourmaline::solve
