#include "material/constants.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "case/given.h"
#include "case/symmetry.h"
#include "dense/decompositions.h"
#include "material/completeness.h"
#include "material/coupling.h"
#include "material/crystal_class.h"
#include "material/library.h"
#include "material/positive.h"
#include "tourmaline/case/material_case.h"
#include "tourmaline/error.h"

namespace tourmaline::material {

namespace {

using casefile::MaterialCase;

std::string symmetry_of(const MaterialCase &given) {
  return given.symmetry.value_or("6mm");
}

Stiffness matrix66(const std::vector<std::vector<double>> &rows) {
  Stiffness m;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j)
      m(i, j) = rows.at(i).at(j);
  return m;
}

Piezoelectric matrix36(const std::vector<std::vector<double>> &rows) {
  Piezoelectric m;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 6; ++j)
      m(i, j) = rows.at(i).at(j);
  return m;
}

Tensor matrix33(const std::vector<std::vector<double>> &rows) {
  Tensor m;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      m(i, j) = rows.at(i).at(j);
  return m;
}

// (p1, p3) in two dimensions, where the plane is the crystal's 1-3 plane; all three otherwise.
Vector pyroelectric_of(const std::vector<double> &p) {
  return p.size() == 2 ? Vector(p[0], 0, p[1]) : Vector(p.at(0), p.at(1), p.at(2));
}

// Formulas below: IEEE Std 176-1987, table 4, with D = e eps + eps^S E + p^S theta and the strain
// s sigma + d^T E + a theta.
class Conversion {
 public:
  static constexpr double vacuum = 8.8541878128e-12;  // CODATA 2018 [C/(V m)]

  explicit Conversion(const MaterialCase &given)
      : given_(given), crystal_{symmetry_of(given), given.place(), given.constants} {}

  Stiffness stiffness() const {
    if (given_.stiffness)
      return matrix66(*given_.stiffness);
    if (given_.compliance)
      return inverse(matrix66(*given_.compliance));
    return crystal_.gives("s11") ? inverse(crystal_.compliance()) : crystal_.stiffness();
  }

  Piezoelectric piezoelectric(const Stiffness &c) const {
    if (given_.piezoelectric)
      return matrix36(*given_.piezoelectric);
    if (given_.strain_coefficients)
      return matrix36(*given_.strain_coefficients) * c;
    if (gives_any("d"))
      return crystal_.strain_coefficients() * c;
    return gives_any("e") ? crystal_.stress_coefficients() : Piezoelectric(Piezoelectric::Zero());
  }

  Tensor permittivity(const Stiffness &c, const Piezoelectric &e) const {
    if (given_.permittivity)
      return matrix33(*given_.permittivity);
    if (const std::optional<Tensor> free = free_permittivity())
      return *free - clamped_part({.stiffness = c, .piezoelectric = e});
    return crystal_.gives("eps11") ? along_axes("eps", "", vacuum) : along_axes("beta", "", 1);
  }

  Voigt thermal_stress(const Stiffness &c) const {
    if (given_.thermal_stress)
      return Eigen::Map<const Voigt>(given_.thermal_stress->data());
    if (given_.thermal_expansion)
      return c * Eigen::Map<const Voigt>(given_.thermal_expansion->data());
    if (gives_any("a"))
      return c * normal(crystal_.diagonal("a"));
    return gives_any("m") ? normal(crystal_.diagonal("m")) : Voigt(Voigt::Zero());
  }

  Vector pyroelectric(const Stiffness &c, const Piezoelectric &e, const Voigt &m) const {
    const Vector by_expansion = e * dense::solve(c, m);  // p^T - p^S
    if (given_.pyroelectric)
      return pyroelectric_of(*given_.pyroelectric);
    if (given_.pyroelectric_T)
      return pyroelectric_of(*given_.pyroelectric_T) - by_expansion;
    if (crystal_.gives("p3_T"))
      return Vector(0, 0, crystal_.need("p3_T")) - by_expansion;
    return {0, 0, crystal_.gives("p3") ? crystal_.need("p3") : 0};
  }

  Tensor conductivity() const {
    return given_.conductivity ? matrix33(*given_.conductivity)
                               : Tensor(crystal_.diagonal("k").asDiagonal());
  }

  const CrystalClass &crystal() const { return crystal_; }

  /// eps^T, where that is what is given
  std::optional<Tensor> free_permittivity() const {
    if (given_.permittivity_T)
      return matrix33(*given_.permittivity_T);
    if (crystal_.gives("eps11_T"))
      return along_axes("eps", "_T", vacuum);
    return std::nullopt;
  }

 private:
  bool gives_any(const std::string &letters) const {
    return std::any_of(given_.constants.begin(), given_.constants.end(), [&](const auto &constant) {
      return casefile::form_of(constant.first).form == letters;
    });
  }

  Stiffness inverse(const Stiffness &compliance) const {
    need_positive(compliance, "compliance", given_.place());
    const Stiffness c = dense::inverse(compliance);
    return (c + c.transpose()) / 2;
  }

  Tensor along_axes(const char *letters, const char *suffix, double unit) const {
    return Tensor((unit * crystal_.diagonal(letters, suffix)).asDiagonal());
  }

  static Voigt normal(const Vector &v) {
    Voigt voigt;
    voigt << v, 0, 0, 0;
    return voigt;
  }

  const MaterialCase &given_;
  CrystalClass crystal_;
};

void check_class(const MaterialCase &given) {
  for (const auto &[constant, value] : given.constants)
    if (const std::string reason = casefile::absence(symmetry_of(given), constant); !reason.empty())
      throw CaseError(fmt::format("{} {}: {}", given.place(), constant, reason));
}

void check_conductor(const MaterialCase &given) {
  const auto is_electric = [](const std::string &key) {
    const std::string kind = casefile::form_of(key).kind;
    return kind == "permittivity" || kind == "piezoelectric" || kind == "pyroelectric";
  };
  for (const auto &[key, value] : given.constants)
    if (is_electric(key))
      throw CaseError(fmt::format("{} {} is given for a conductor, in which there is no field",
                                  given.place(), key));
  for (const auto &[key, is_given] : casefile::given_tensors(given))
    if (is_given && is_electric(key))
      throw CaseError(fmt::format("{} {} is given for a conductor, in which there is no field",
                                  given.place(), key));
}

}  // namespace

namespace {

// eps^T is measured, and with piezoelectric constants that are too large for it nothing is left of
// eps^S = eps^T - d c d^T.
void check_coupling(const Conversion &conversion, const Constants &c, const std::string &where) {
  const std::optional<Tensor> free = conversion.free_permittivity();
  if (!free)
    return;
  const LeastEnergy at_strain = least_energy(c.permittivity), at_stress = least_energy(*free);
  if (at_strain.value > 0 || !(at_stress.value > 0))
    return;
  throw CaseError(fmt::format(
      "{} permittivity at constant strain, eps^T - d c d^T, is not positive definite: its smallest "
      "eigenvalue is {:.6g} C/(V m), of the state {}, although that of eps^T is {:.6g}. The "
      "piezoelectric constants are too large for this stiffness and permittivity (coupling factor "
      "{:.4g}, and none reaches 1): check their units, d in C/N (1 pC/N = 1e-12 C/N), e in C/m^2, "
      "stiffness in Pa (1 GPa = 1e9 Pa), compliance in 1/Pa",
      where, at_strain.value, at_strain.state, at_stress.value,
      coupling_factor(clamped_part(c), *free)));
}

}  // namespace

MaterialCase with_entry(const MaterialCase &asked) {
  MaterialCase given = asked.library ? casefile::merged(find(asked).given, asked) : asked;
  given.left_out = asked.left_out;
  return casefile::without_left_out(std::move(given));
}

Constants electromechanical(const MaterialCase &given) {
  check_class(given);
  const Conversion conversion(given);
  Constants c;
  c.stiffness = conversion.stiffness();
  need_positive(c.stiffness, "stiffness", given.place());
  if (given.conductor.value_or(false)) {
    check_conductor(given);
    return c;
  }
  c.piezoelectric = conversion.piezoelectric(c.stiffness);
  c.permittivity = conversion.permittivity(c.stiffness, c.piezoelectric);
  check_coupling(conversion, c, given.place());
  return c;
}

namespace {

// `"PVDF-film", class 6mm, lacks: density`; empty when it lacks nothing.
std::string lack_of(const MaterialCase &given) {
  const std::string missing = missing_words(given);
  return missing.empty()
             ? ""
             : fmt::format("{}, class {}, lacks: {}",
                           given.library ? "\"" + *given.library + "\"" : "the material",
                           symmetry_of(given), missing);
}

// Which entry a file of materials has, that file says; the built-in library nobody changes.
std::string remedy(const std::string &files, bool some_have_entries, bool some_have_none) {
  const std::string beside = some_have_entries ? " beside `library`" : "";
  return fmt::format(". Give them{}{}", files.empty() ? beside : " in " + files + ", or" + beside,
                     some_have_none ? ", or a library entry that has them (`tourmaline materials` "
                                      "lists them)"
                                    : "") +
         "; a field that [model] leaves out (`thermal = false`, `electric = false`) needs none";
}

}  // namespace

void require_complete(const std::vector<MaterialCase> &materials) {
  std::vector<std::pair<std::string, std::string>> lacks;  // what, and of which
  bool entries = false, none = false;
  std::string files;
  for (const MaterialCase &asked : materials) {
    const MaterialCase given = with_entry(asked);
    check_class(given);
    const std::string lack = lack_of(given);
    if (lack.empty())
      continue;
    (given.library ? entries : none) = true;
    if (given.file && files.find(*given.file) == std::string::npos)
      files += (files.empty() ? "" : " and ") + *given.file;
    const auto same = std::find_if(lacks.begin(), lacks.end(),
                                   [&](const auto &other) { return other.first == lack; });
    if (same == lacks.end())
      lacks.emplace_back(lack, given.place());
    else
      same->second += ", " + given.place();
  }
  std::string text;
  for (const auto &[lack, places] : lacks)
    text += (text.empty() ? "" : "; and ") + places + " " + lack;
  if (!text.empty())
    throw CaseError(text + remedy(files, entries, none));
}

namespace {

// The equations of fields that nothing moves and nothing couples keep their places. Sizes are those
// of water, so that nothing else takes them for a mistake.
void fill_left_out(MaterialCase &given) {
  const auto unit = [](double size) {
    return std::vector<std::vector<double>>{{size, 0, 0}, {0, size, 0}, {0, 0, size}};
  };
  if (given.left_out.contains("permittivity") && !given.conductor.value_or(false))
    given.permittivity = unit(Conversion::vacuum);
  if (given.left_out.contains("conductivity"))
    given.conductivity = unit(0.6);
  for (const auto &[scalar, size] :
       {std::pair{"density", 1000.}, {"specific_heat", 4200.}, {"reference_temperature", 293.}})
    if (given.left_out.contains(scalar))
      given.constants.try_emplace(scalar, size);
}

}  // namespace

Constants constants_of(const MaterialCase &asked) {
  require_complete({asked});
  MaterialCase given = with_entry(asked);
  fill_left_out(given);
  Constants c = electromechanical(given);
  const Conversion conversion(given);
  c.conductor = given.conductor.value_or(false);
  c.thermal_stress = conversion.thermal_stress(c.stiffness);
  if (!c.conductor)
    c.pyroelectric = conversion.pyroelectric(c.stiffness, c.piezoelectric, c.thermal_stress);
  c.conductivity = conversion.conductivity();
  c.density = conversion.crystal().need("density");
  c.specific_heat = conversion.crystal().need("specific_heat");
  c.reference_temperature = conversion.crystal().need("reference_temperature");
  for (const auto &[key, damping] : {std::pair{"stiffness_damping", &c.stiffness_damping},
                                     std::pair{"mass_damping", &c.mass_damping}})
    *damping = conversion.crystal().gives(key) ? conversion.crystal().need(key) : 0;
  check_stored_energy(c, given.place());
  return c;
}

std::string couplings(const Constants &c) {
  const char *expands =
      c.thermal_stress.isZero(0) ? "without thermal expansion" : "with thermal expansion";
  if (c.conductor)
    return fmt::format("a conductor, {}", expands);
  return fmt::format("{}piezoelectric, {}pyroelectric, {}", c.piezoelectric.isZero(0) ? "not " : "",
                     c.pyroelectric.isZero(0) ? "not " : "", expands);
}

void check_stored_energy(const Constants &constants, const std::string &where) {
  if (!(constants.heat_capacity() > 0) || !std::isfinite(constants.heat_capacity()))
    throw CaseError(where + " density, specific_heat and reference_temperature must be positive");
  need_positive(constants.stiffness, "stiffness", where);
  need_positive(constants.conductivity, "conductivity", where);
  if (constants.conductor)
    return;
  need_positive(constants.permittivity, "permittivity", where);
  // The electro-thermal part in units in which permittivity and heat capacity are about 1.
  const double volt = 1 / std::sqrt(constants.permittivity.trace() / 3);
  const double kelvin = 1 / std::sqrt(constants.heat_capacity());
  Eigen::Matrix4d energy;
  energy.topLeftCorner<3, 3>() = constants.permittivity * volt * volt;
  energy.topRightCorner<3, 1>() = constants.pyroelectric * volt * kelvin;
  energy.bottomLeftCorner<1, 3>() = energy.topRightCorner<3, 1>().transpose();
  energy(3, 3) = 1;
  need_positive(
      energy,
      "the electro-thermal energy [permittivity pyroelectric; pyroelectric^T rho c_v / theta_ref]",
      where);
}

}  // namespace tourmaline::material
