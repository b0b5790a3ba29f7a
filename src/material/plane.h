#pragma once

#include "material/constants.h"

namespace tourmaline::material {

/// Components of a symmetric tensor that a body of `dim` dimensions may have: xx, yy, zz, xy or all
/// six of Voigt.
template <int dim>
inline constexpr int n_strains = dim == 2 ? 4 : 6;

/// What a two-dimensional body does across its plane, with E_z = 0 in all: eps_zz = eps_yz =
/// eps_xz = 0; sigma_zz = sigma_yz = sigma_xz = 0; or, where it is a body of revolution and z goes
/// around, eps_zz = u_x / x and eps_yz = eps_xz = 0.
enum class Plane { strain, stress, axisymmetric };

/// The constants that a body of `dim` dimensions sees, in its own axes. In plane stress the strains
/// across the plane have been eliminated, eps_zz = 0 stands for them, and what belongs to it
/// couples with nothing; damping of the stiffness acts on what is left of it.
template <int dim>
struct BodyConstants {
  static constexpr int strains = n_strains<dim>;
  Eigen::Matrix<double, strains, strains> stiffness;
  Eigen::Matrix<double, dim, strains> piezoelectric;
  Eigen::Matrix<double, dim, dim> permittivity;
  Eigen::Matrix<double, strains, 1> thermal_stress;
  Eigen::Matrix<double, dim, 1> pyroelectric;
  Eigen::Matrix<double, dim, dim> conductivity;
  double heat_capacity = 0;          ///< alpha [J/(K^2 m^3)]
  double reference_temperature = 0;  ///< theta_ref [K]
  double density = 0;                ///< rho [kg/m^3]
  double stiffness_damping = 0;      ///< [s]
  double mass_damping = 0;           ///< [1/s]
};

/// Throws CaseError, but in plane stress, when the plane's fields would drive a displacement out of
/// the plane: it is then no solution of (1)-(6).
template <int dim>
BodyConstants<dim> restricted(const Constants &body_axes, Plane plane = Plane::strain);
template <>
BodyConstants<2> restricted<2>(const Constants &body_axes, Plane plane);
template <>
BodyConstants<3> restricted<3>(const Constants &body_axes, Plane plane);

/// eps_zz, 2 eps_yz and 2 eps_xz of plane stress, from the strains of the plane (the others of
/// `strain` are not looked at), E [V/m] and theta [K].
Eigen::Vector3d strains_across(const Constants &body_axes, const Voigt &strain,
                               const Eigen::Vector3d &field, double theta);

}  // namespace tourmaline::material
