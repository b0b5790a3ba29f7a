#pragma once

#include <string>
#include <vector>

namespace tourmaline::casefile {

/// Classes of crystals and what behaves like them, whose tensors named constants can give:
/// isotropic, cubic (non-piezoelectric), 6mm (and poled ceramics), 3m, 32, mm2.
const std::vector<std::string> &symmetry_classes();

/// The constants that may be given for a class, by kind.
struct ClassConstants {
  std::vector<std::string> elastic;        ///< without the letter: "11" stands for c11 and s11
  std::vector<std::string> piezoelectric;  ///< "31" stands for e31 and d31
  std::vector<std::string> diagonal;       ///< of the symmetric tensors of second order: "11", "33"
  bool polar = false;                      ///< whether there is a pyroelectric constant p3
};
const ClassConstants &constants_of_class(const std::string &symmetry);

/// What a constant is part of and in which form it says so. Tensors given as a whole are a form of
/// their own kind, named like their key.
struct ConstantForm {
  std::string kind;  ///< elastic, piezoelectric, permittivity, thermal, pyroelectric, conductivity
  std::string form;  ///< c, s, young; e, d; beta, eps, eps_T; m, a; p, p_T; k; or the tensor's key
};
/// An empty kind for density, specific_heat and reference_temperature, which stand alone.
ConstantForm form_of(const std::string &constant);

/// Why a crystal of the class has no such constant; empty when it has.
std::string absence(const std::string &symmetry, const std::string &constant);

}  // namespace tourmaline::casefile
