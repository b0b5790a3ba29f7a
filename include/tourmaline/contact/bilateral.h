#pragma once

#include <Eigen/Dense>
#include <array>
#include <optional>

namespace tourmaline::contact {

/// Bilateral contact (9), u_nu = 0, at one node of which some components may be prescribed as well:
/// the admissible displacements are u = base + directions z with free z.
template <int dim>
struct Admissible {
  using Vector = Eigen::Matrix<double, dim, 1>;

  Vector base;  ///< [m]
  /// orthonormal columns, tangential and orthogonal to the prescribed components
  Eigen::Matrix<double, dim, Eigen::Dynamic, 0, dim, dim> directions;
};

/// `prescribed[c]` [m] where component c is prescribed. Where the normal lies in the span of
/// prescribed components the prescribed values hold, not u_nu = 0.
template <int dim>
Admissible<dim> bilateral(const Eigen::Matrix<double, dim, 1> &normal,
                          const std::array<std::optional<double>, dim> &prescribed);

}  // namespace tourmaline::contact
