#include <fmt/format.h>

#include <cmath>
#include <map>
#include <utility>

#include "case/given.h"
#include "case/symmetry.h"
#include "schema_parts.h"
#include "sense.h"
#include "tourmaline/case/material_case.h"

namespace tourmaline::casefile {

namespace {

const char *axes_words(const std::string &indices) {
  static const std::map<std::string, const char *> words{{"11", "along axis 1"},
                                                         {"22", "along axis 2"},
                                                         {"33", "along axis 3"},
                                                         {"12", "between axes 1 and 2"},
                                                         {"13", "between axes 1 and 3"},
                                                         {"23", "between axes 2 and 3"},
                                                         {"14", "between axis 1 and the shear 23"},
                                                         {"44", "of the shear 23"},
                                                         {"55", "of the shear 13"},
                                                         {"66", "of the shear 12"}};
  return words.at(indices);
}

Key elastic(const std::string &letter, const std::string &indices) {
  const bool stiffness = letter == "c";
  const bool diagonal = indices[0] == indices[1];
  return {.name = letter + indices,
          .description = std::string(stiffness ? "stiffness " : "compliance ") +
                         axes_words(indices) + ", at constant electric field",
          .unit = stiffness ? "Pa" : "1/Pa",
          .range = stiffness  ? diagonal ? positive(sense::stiffness) : any(sense::elastic_coupling)
                    : diagonal ? positive(sense::compliance)
                              : any(sense::compliant_coupling)};
}

Key piezoelectric(const std::string &letter, const std::string &indices) {
  return {.name = letter + indices,
          .description = fmt::format("charge along axis {} for the {} {} (Voigt)", indices[0],
                                     letter == "e" ? "strain" : "stress", indices[1]),
          .unit = letter == "e" ? "C/m^2" : "C/N",
          .range = any(letter == "e" ? sense::stress_coefficient : sense::strain_coefficient)};
}

Key diagonal(const std::string &name, const std::string &what, const std::string &unit,
             Range range) {
  const std::size_t digit = name.find_first_of("123");
  return {.name = name,
          .description = what + " " + axes_words(name.substr(digit, 2)),
          .unit = unit,
          .range = range};
}

void add_diagonals(std::vector<Key> &all, const std::string &letters, const std::string &suffix,
                   const std::string &what, const std::string &unit, Range range) {
  for (const char *indices : {"11", "22", "33"})
    all.push_back(diagonal(letters + indices + suffix, what, unit, range));
}

Key also_called(Key key, std::vector<std::string> names) {
  key.also = std::move(names);
  return key;
}

// Signs as in (1)-(3): sigma = F eps - E^T E - M theta, D = E eps + beta E + P theta. Which of them
// a crystal has, its class says (symmetry.h).
std::vector<Key> make_constants() {
  std::vector<Key> all;
  for (const char *letter : {"c", "s"})
    for (const char *indices : {"11", "12", "13", "14", "22", "23", "33", "44", "55", "66"})
      all.push_back(elastic(letter, indices));
  all.push_back(also_called({"young", "Young's modulus of an isotropic material", "Pa", false,
                             positive(sense::stiffness)},
                            {"E", "youngs_modulus", "elastic_modulus"}));
  all.push_back(also_called({"poisson", "Poisson's ratio of an isotropic material", "", false,
                             Range{-1, 0.5, false, false}},
                            {"nu", "poissons_ratio"}));
  for (const char *letter : {"e", "d"})
    for (const char *indices : {"11", "14", "15", "22", "24", "31", "32", "33"})
      all.push_back(piezoelectric(letter, indices));
  add_diagonals(all, "beta", "", "permittivity at constant strain", "C/(V m)",
                positive(sense::permittivity));
  add_diagonals(all, "eps", "", "relative permittivity at constant strain", "",
                {.low = 1, .sense = sense::relative_permittivity});
  add_diagonals(all, "eps", "_T", "relative permittivity at constant stress", "",
                {.low = 1, .sense = sense::relative_permittivity});
  add_diagonals(all, "m", "", "thermal stress coefficient, sigma = ... - m theta,", "N/(K m^2)",
                any(sense::thermal_stress));
  add_diagonals(all, "a", "", "thermal expansion", "1/K", any(sense::thermal_expansion));
  all.push_back({"p3",
                 "pyroelectric coefficient along axis 3 at constant strain: D = ... + p theta",
                 "C/(K m^2)", false, any(sense::pyroelectric)});
  all.push_back({"p3_T", "pyroelectric coefficient along axis 3 at constant stress", "C/(K m^2)",
                 false, any(sense::pyroelectric)});
  add_diagonals(all, "k", "", "thermal conductivity", "W/(K m)", positive(sense::conductivity));
  all.push_back(
      also_called({"density", "rho", "kg/m^3", false, positive(sense::density)}, {"rho"}));
  all.push_back({"stiffness_damping",
                 "viscous stress (Kelvin-Voigt) over stiffness times strain rate; 0 when not given",
                 "s",
                 false,
                 {.low = 0, .sense = sense::damping_time}});
  all.push_back({"mass_damping",
                 "force against the velocity over density times velocity; 0 when not given",
                 "1/s",
                 false,
                 {.low = 0, .sense = sense::damping_rate}});
  all.push_back(
      also_called({"specific_heat", "c_v; the heat capacity of (6) is rho c_v / theta_ref",
                   "J/(kg K)", false, positive(sense::specific_heat)},
                  {"c_v", "cv", "c_p", "cp", "heat_capacity"}));
  all.push_back(
      {.name = "reference_temperature",
       .description = "theta_ref, the absolute temperature that all others are differences to",
       .unit = "K",
       .range = positive(sense::absolute_temperature),
       .also = {"theta_ref", "T_ref", "T0", "T_0"},
       .is_absolute_temperature = true});
  return all;
}

const std::vector<Key> &named_constants() {
  static const std::vector<Key> all = make_constants();
  return all;
}

void declare_constants(Visitor &v, MaterialCase &material) {
  for (const Key &constant : named_constants()) {
    const auto entry = material.constants.find(constant.name);
    std::optional<double> value;
    if (entry != material.constants.end())
      value = entry->second;
    v.optional(constant, value);
    if (value)
      material.constants[constant.name] = *value;
  }
}

const Length six{{6}, "one for each Voigt index"}, three{{3}, "one for each crystal axis"};

void declare_mechanical_tensors(Visitor &v, MaterialCase &material) {
  v.optional(
      {.name = "stiffness",
       .description = "F, instead of c11, ...: rows and columns in the Voigt order 11, 22, 33, "
                      "23, 13, 12, at constant electric field and temperature",
       .unit = "Pa",
       .range = any(sense::elastic_coupling),
       .length = six,
       .rows = 6},
      material.stiffness);
  v.optional({.name = "compliance",
              .description = "inverse of `stiffness`, instead of s11, ...",
              .unit = "1/Pa",
              .range = any(sense::compliant_coupling),
              .length = six,
              .rows = 6},
             material.compliance);
  v.optional({.name = "piezoelectric",
              .description = "E, instead of e31, ...: a row for each axis of the field, columns in "
                             "Voigt order (for engineering shear strains)",
              .unit = "C/m^2",
              .range = any(sense::stress_coefficient),
              .length = six,
              .rows = 3},
             material.piezoelectric);
  v.optional({.name = "strain_coefficients",
              .description = "d, instead of d31, ..., ordered like `piezoelectric`",
              .unit = "C/N",
              .range = any(sense::strain_coefficient),
              .length = six,
              .rows = 3},
             material.strain_coefficients);
}

void declare_thermal_tensors(Visitor &v, MaterialCase &material) {
  v.optional(
      {.name = "thermal_stress",
       .description = "M, instead of m11, ..., in Voigt order; positive when heating a clamped "
                      "body compresses it",
       .unit = "N/(K m^2)",
       .range = any(sense::thermal_stress),
       .length = six},
      material.thermal_stress);
  v.optional({.name = "thermal_expansion",
              .description = "instead of a11, ..., in Voigt order (engineering shear strains)",
              .unit = "1/K",
              .range = any(sense::thermal_expansion),
              .length = six},
             material.thermal_expansion);
  v.optional({.name = "conductivity",
              .description = "K, instead of k11, ...",
              .unit = "W/(K m)",
              .range = any(sense::conductivity_entry),
              .length = three,
              .rows = 3},
             material.conductivity);
}

void declare_electric_tensors(Visitor &v, MaterialCase &material, int dimension) {
  v.optional({.name = "permittivity",
              .description = "beta, instead of beta11, ..., at constant strain",
              .unit = "C/(V m)",
              .range = any(sense::permittivity_entry),
              .length = three,
              .rows = 3},
             material.permittivity);
  v.optional({.name = "permittivity_T",
              .description = "the same at constant stress",
              .unit = "C/(V m)",
              .range = any(sense::permittivity_entry),
              .length = three,
              .rows = 3},
             material.permittivity_T);
  // In the plane of the axes 1 and 3 nobody wants to write the second entry.
  const Length pyroelectric = dimension == 2 ? Length{{2, 3}, "[p1, p3] or [p1, p2, p3]"} : three;
  v.optional(
      {.name = "pyroelectric",
       .description = "P, instead of p3, at constant strain: [p1, p2, p3], in two dimensions "
                      "also [p1, p3]",
       .unit = "C/(K m^2)",
       .range = any(sense::pyroelectric),
       .length = pyroelectric},
      material.pyroelectric);
  v.optional({.name = "pyroelectric_T",
              .description = "the same at constant stress",
              .unit = "C/(K m^2)",
              .range = any(sense::pyroelectric),
              .length = pyroelectric},
             material.pyroelectric_T);
}

// What is given, by kind and form, with the key that says so.
std::map<std::string, std::map<std::string, std::string>> given_forms(
    const MaterialCase &material) {
  std::map<std::string, std::map<std::string, std::string>> given;
  const auto add = [&](const std::string &key) {
    if (const ConstantForm form = form_of(key); !form.kind.empty())
      given[form.kind].try_emplace(form.form, key);
  };
  for (const auto &[key, value] : material.constants)
    add(key);
  for (const auto &[key, is_given] : given_tensors(material))
    if (is_given)
      add(key);
  return given;
}

// One constant in two forms would have two values.
std::string twice_complaint(const MaterialCase &material, const std::string &key) {
  if (!material.constants.contains(key))
    return "";
  const ConstantForm own = form_of(key);
  const auto given = given_forms(material);
  if (const auto kind = given.find(own.kind); kind != given.end())
    for (const auto &[form, other] : kind->second)
      if (form != own.form)
        return fmt::format("given twice, here and in `{}`; give all of one kind in one form",
                           other);
  return "";
}

std::string class_complaint(const MaterialCase &material, const std::string &key) {
  if (!material.constants.contains(key) || material.library)
    return "";  // of an entry, the class is not known here
  return absence(material.symmetry.value_or("6mm"), key);
}

void check_constants(Visitor &v, const MaterialCase &material) {
  for (const Key &constant : named_constants()) {
    v.check(constant.name, [&] { return class_complaint(material, constant.name); });
    v.check(constant.name, [&] { return twice_complaint(material, constant.name); });
  }
}

double length_of(const std::vector<double> &direction) {
  double square = 0;
  for (const double entry : direction)
    square += entry * entry;
  return std::sqrt(square);
}

std::string direction_complaint(const std::vector<double> &direction) {
  const bool usable = direction.empty() || std::isnormal(length_of(direction));
  return usable ? "" : "is no direction; its length must not be 0";
}

// Nothing where the direction depends on the place, which is looked at cell by cell.
std::vector<double> numbers(const FormulaVector &direction) {
  std::vector<double> all;
  for (const Formula &entry : direction)
    if (entry.is_number())
      all.push_back(entry.value({}, 0));
  return all.size() == direction.size() ? all : std::vector<double>{};
}

// `poling` as given, or the last axis, which is its default.
std::vector<double> poling_of(const MaterialCase &material, int dimension) {
  if (!material.poling.empty())
    return numbers(material.poling);
  std::vector<double> last(static_cast<std::size_t>(dimension), 0.0);
  last.back() = 1;
  return last;
}

std::string axis_complaint(const MaterialCase &material, int dimension) {
  if (material.axis1.empty())
    return "";
  if (std::string text = direction_complaint(material.axis1); !text.empty())
    return text;
  const std::vector<double> poling = poling_of(material, dimension);
  double along = 0;
  for (std::size_t i = 0; i < poling.size(); ++i)
    along += poling[i] / length_of(poling) * material.axis1[i] / length_of(material.axis1);
  return std::abs(along) < 1 - 1e-12 ? "" : "is parallel to the poling axis, which is axis 3";
}

void declare_orientation(Visitor &v, MaterialCase &material, int dimension) {
  v.key({.name = "poling",
         .description = "direction of the crystal's axis 3, of any length; formulas give one by "
                        "place, as [\"x\", \"y\"] the radial one",
         .range = any(sense::direction),
         .length = one_each_axis(dimension),
         .constant_in_time = true,
         .default_words = "y in 2D, z in 3D"},
        &material.poling);
  v.key({.name = "axis1",
         .description =
             "direction of the crystal's axis 1, made orthogonal to `poling`; matters only "
             "for crystals that are not isotropic about axis 3",
         .range = any(sense::direction),
         .length = one_each_axis(dimension),
         .default_words = "x, or any direction when x is the poling axis"},
        &material.axis1);
  v.check("poling", [&] { return direction_complaint(numbers(material.poling)); });
  v.check("axis1", [&] { return axis_complaint(material, dimension); });
}

void declare_properties(Visitor &v, MaterialCase &material, int dimension) {
  v.optional({.name = "symmetry",
              .description = "class of the crystal, which says what constants there are and what "
                             "follows from them; 6mm stands for poled ceramics too, cubic for "
                             "crystals that are not piezoelectric",
              .choices = symmetry_classes(),
              .default_words = "the entry's, or 6mm"},
             material.symmetry);
  v.optional({.name = "conductor",
              .description = "true: a metal, in which there is no electric field; its permittivity "
                             "is not given (docs/conventions.md)",
              .default_words = "the entry's, or false"},
             material.conductor);
  declare_constants(v, material);
  declare_mechanical_tensors(v, material);
  declare_electric_tensors(v, material, dimension);
  declare_thermal_tensors(v, material);
  check_constants(v, material);
}

}  // namespace

void declare(Visitor &v, MaterialCase &material, int dimension) {
  v.place(material.where);
  v.optional(
      {.name = "library",
       .description = "entry of the built-in library (`tourmaline materials` lists them), or "
                      "of `file`; a constant that is given as well overrides the entry's, "
                      "and one in another form than the entry's replaces all of its kind"},
      material.library);
  v.optional({.name = "file",
              .description =
                  "file of materials of one's own, found from the folder of the case: a "
                  "table for each, with the keys of this one and `source`, a text that says where "
                  "the numbers are from and must be given",
              .used = with("library", material.library.has_value())},
             material.file);
  if (material.file)
    v.locate("file", *material.file);
  declare_properties(v, material, dimension);
  declare_orientation(v, material, dimension);
}

void declare_entry(Visitor &v, MaterialCase &entry) {
  v.place(entry.where);
  v.key({.name = "source", .description = "where the numbers are from", .required = true},
        &entry.source);
  v.key({.name = "not_given", .description = "constants that a case must add to this entry"},
        &entry.not_given);
  declare_properties(v, entry, 3);
}

}  // namespace tourmaline::casefile
