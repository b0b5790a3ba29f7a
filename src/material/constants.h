#pragma once

#include <Eigen/Dense>
#include <array>
#include <string>
#include <vector>

namespace tourmaline::casefile {
struct MaterialCase;
}

namespace tourmaline::material {

/// Voigt order: 11, 22, 33, 23, 13, 12; shear strains are engineering strains (2 eps_ij).
using Voigt = Eigen::Matrix<double, 6, 1>;
using Stiffness = Eigen::Matrix<double, 6, 6>;
using Piezoelectric = Eigen::Matrix<double, 3, 6>;
using Vector = Eigen::Vector3d;
using Tensor = Eigen::Matrix3d;

/// The tensors of (1)-(3) in stress-charge form, constants at constant strain, in three dimensions:
///     sigma = F eps(u) - E^T E(phi) - M theta,   q = -K grad theta,
///     D = E eps(u) + beta E(phi) + P theta.
struct Constants {
  Stiffness stiffness = Stiffness::Zero();              ///< F [Pa]
  Piezoelectric piezoelectric = Piezoelectric::Zero();  ///< E, e_{i,jk} [C/m^2]
  Tensor permittivity = Tensor::Zero();                 ///< beta [C/(V m)]
  Voigt thermal_stress = Voigt::Zero();                 ///< M [N/(K m^2)]
  Vector pyroelectric = Vector::Zero();                 ///< P [C/(K m^2)]
  Tensor conductivity = Tensor::Zero();                 ///< K [W/(K m)]
  double density = 0;                                   ///< rho [kg/m^3]
  double specific_heat = 0;                             ///< c_v [J/(kg K)]
  double stiffness_damping = 0;                         ///< viscous stress = this F eps(du/dt) [s]
  double mass_damping = 0;                              ///< force = this rho du/dt [1/s]
  double reference_temperature = 0;                     ///< theta_ref [K]
  bool conductor = false;  ///< no field inside; the electric constants are zero

  /// alpha = rho c_v / theta_ref of (6) [J/(K^2 m^3)]
  double heat_capacity() const { return density * specific_heat / reference_temperature; }
};

/// The constants that a case asks for, in crystal axes: the library's entry, then what the case
/// gives, all in stress-charge form at constant strain. Throws CaseError for an unknown entry,
/// constants that are missing (`gaps`, all at once), one that the crystal's class does not have, or
/// a stored energy that is not positive.
Constants constants_of(const casefile::MaterialCase &asked);

/// The entry of the library, or of the case's own file of materials, with what the case gives laid
/// over it; the case itself when it names none.
casefile::MaterialCase with_entry(const casefile::MaterialCase &asked);

/// The electromechanical part of `constants_of` for a material with its entry: elasticity,
/// piezoelectricity and permittivity; the others stay zero.
Constants electromechanical(const casefile::MaterialCase &given);
/// What of the couplings there is and what not: "piezoelectric, not pyroelectric, without thermal
/// expansion"; "a conductor, with thermal expansion".
std::string couplings(const Constants &constants);

/// Throws CaseError unless elasticity, conductivity and the electro-thermal energy
/// [beta P; P^T alpha] are symmetric and positive definite: the operator of a step is then
/// symmetric quasi-definite, and a step has exactly one solution. `where` begins the error's text.
void check_stored_energy(const Constants &constants, const std::string &where = "[material]");

}  // namespace tourmaline::material
