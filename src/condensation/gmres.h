#pragma once

#include <Eigen/Dense>
#include <functional>

namespace tourmaline::condensation {

using LinearMap = std::function<Eigen::VectorXd(const Eigen::VectorXd &)>;

/// x of A x = b by GMRES on M A x = M b, M an approximate inverse of A, until |M (b - A x)| is
/// `reduction` of |M b| or after `iterations` products. What M has wrong in few directions takes as
/// many iterations.
Eigen::VectorXd gmres(const LinearMap &product, const LinearMap &approximate_inverse,
                      const Eigen::VectorXd &b, double reduction, int iterations);

}  // namespace tourmaline::condensation
