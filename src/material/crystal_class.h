#pragma once

#include <map>
#include <string>

#include "material/constants.h"

namespace tourmaline::material {

/// Named constants of a crystal, in the tensors' full form by the symmetry of its class (IEEE Std
/// 176-1987, table 8; J. F. Nye, Physical Properties of Crystals, appendix). Each throws CaseError,
/// beginning with `where`, for a constant that is missing.
struct CrystalClass {
  std::string symmetry, where;
  const std::map<std::string, double> &named;

  bool gives(const std::string &constant) const { return named.contains(constant); }
  double need(const std::string &constant) const;

  Stiffness stiffness() const;                ///< c11, ... or young, poisson [Pa]
  Stiffness compliance() const;               ///< s11, ... [1/Pa]
  Piezoelectric stress_coefficients() const;  ///< e31, ... [C/m^2]
  Piezoelectric strain_coefficients() const;  ///< d31, ... [C/N]
  /// letter11, letter22, letter33 with a suffix: "beta" + "", "eps" + "_T", ...
  Vector diagonal(const std::string &letters, const std::string &suffix = "") const;
};

}  // namespace tourmaline::material
