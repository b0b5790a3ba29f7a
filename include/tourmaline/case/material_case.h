#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "tourmaline/case/formula.h"

namespace tourmaline::casefile {

/// [material], [region.material], and an entry of a file of materials: constants in crystal axes,
/// of the stress-charge or the strain-charge form. What is not given is taken from the library's
/// entry; without an entry it must be given.
struct MaterialCase {
  std::string where;  ///< file and line of the table, for error texts
  std::optional<std::string> library;
  std::optional<std::string> file;      ///< of materials, absolute once it is read
  std::string source;                   ///< of an entry: where its numbers are from
  std::vector<std::string> not_given;   ///< of an entry: what a case must add to it
  std::optional<std::string> symmetry;  ///< one of `symmetry_classes`; 6mm when nothing says it
  std::optional<bool> conductor;        ///< no electric field inside
  /// scalar constants by their usual names (`constants_of_class`)
  std::map<std::string, double> constants;
  std::optional<std::vector<std::vector<double>>> compliance;           ///< 6x6 Voigt [1/Pa]
  std::optional<std::vector<std::vector<double>>> strain_coefficients;  ///< d, 3x6 Voigt [C/N]
  std::optional<std::vector<std::vector<double>>> permittivity_T;       ///< 3x3 [C/(V m)]
  std::optional<std::vector<double>> thermal_expansion;                 ///< 6 Voigt [1/K]
  std::optional<std::vector<double>> pyroelectric_T;                    ///< as `pyroelectric`
  std::optional<std::vector<std::vector<double>>> stiffness;            ///< 6x6 Voigt [Pa]
  std::optional<std::vector<std::vector<double>>> piezoelectric;        ///< 3x6 Voigt [C/m^2]
  std::optional<std::vector<std::vector<double>>> permittivity;         ///< 3x3 [C/(V m)]
  std::optional<std::vector<double>> thermal_stress;                    ///< 6 Voigt [N/(K m^2)]
  std::optional<std::vector<double>> pyroelectric;  ///< (p1, p3) in 2D, or (p1, p2, p3) [C/(K m^2)]
  std::optional<std::vector<std::vector<double>>> conductivity;  ///< 3x3 [W/(K m)]
  /// direction of the crystal's axis 3 (the poling axis), by place; empty: y in 2D, z in 3D
  FormulaVector poling;
  /// direction of the crystal's axis 1, made orthogonal to `poling`; empty: x, or any when x is the
  /// poling axis. Matters only for crystals that are not isotropic about axis 3.
  std::vector<double> axis1;
  /// kinds of constants (`form_of`) and single ones that the case's model does without, so that
  /// they are not asked for and what is given of them is not looked at
  std::set<std::string> left_out;

  /// For error texts; a case that was not read from a file says the table's name.
  std::string place() const { return where.empty() ? "[material]" : where; }
};

/// One [[region]] entry: a part of the body, by the names in a mesh file or by a condition on the
/// centres of the cells, and what it is made of.
struct RegionCase {
  std::optional<std::string> name;  ///< by which probes know it; of no other one
  std::vector<std::string> on;
  std::optional<Formula> inside;  ///< `where` in the case file: a cell belongs to it where not zero
  std::string place;              ///< file and line of the entry, for error texts
  MaterialCase material;
};

}  // namespace tourmaline::casefile
