#pragma once

#include <Eigen/Core>
#include <string>

namespace tourmaline::material {

/// The smallest eigenvalue of a symmetric matrix of constants, and the state of unit length that it
/// belongs to: "0.71 eps11 - 0.71 eps22".
struct LeastEnergy {
  double value;
  std::string state;
};

/// Of 6 x 6 constants the states are strains, of smaller ones (E1, E2, E3, theta).
LeastEnergy least_energy(const Eigen::MatrixXd &constants);

/// Throws CaseError, with the state of least energy, unless the matrix is symmetric and positive
/// definite; `name` and `where` are for the message.
void need_positive(const Eigen::MatrixXd &constants, const std::string &name,
                   const std::string &where);

}  // namespace tourmaline::material
