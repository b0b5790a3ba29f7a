#include <fmt/format.h>

#include <cmath>

#include "tourmaline/case/schema.h"

namespace tourmaline::casefile {

namespace {

struct Constant {
  Key key;
  std::string tensor;  ///< the key that gives the whole tensor; empty when there is none
};

// The constants of a crystal of class 6mm (and of poled ceramics) with the axis 3 as its axis of
// symmetry. Signs as in (1)-(3): sigma = F eps - E^T E - M theta, D = E eps + beta E + P theta.
const std::vector<Constant> &named_constants() {
  static const std::vector<Constant> all = {
      {{"c11", "stiffness along axis 1 (and 2)", "Pa", false, positive()}, "stiffness"},
      {{"c12", "stiffness between axes 1 and 2", "Pa"}, "stiffness"},
      {{"c13", "stiffness between axis 3 and axis 1 (and 2)", "Pa"}, "stiffness"},
      {{"c33", "stiffness along axis 3", "Pa", false, positive()}, "stiffness"},
      {{"c44", "shear stiffness in planes through axis 3", "Pa", false, positive()}, "stiffness"},
      {{"e31", "charge along axis 3 for a strain along axis 1", "C/m^2"}, "piezoelectric"},
      {{"e33", "charge along axis 3 for a strain along axis 3", "C/m^2"}, "piezoelectric"},
      {{"e15", "charge along axis 1 for a shear in the plane of the axes 1 and 3", "C/m^2"},
       "piezoelectric"},
      {{"beta11", "permittivity across axis 3 at constant strain", "C/(V m)", false, positive()},
       "permittivity"},
      {{"beta33", "permittivity along axis 3 at constant strain", "C/(V m)", false, positive()},
       "permittivity"},
      {{"m11", "thermal stress coefficient across axis 3: sigma = ... - m theta", "N/(K m^2)"},
       "thermal_stress"},
      {{"m33", "thermal stress coefficient along axis 3", "N/(K m^2)"}, "thermal_stress"},
      {{"p3", "pyroelectric coefficient along axis 3 at constant strain: D = ... + p theta",
        "C/(K m^2)"},
       "pyroelectric"},
      {{"k11", "thermal conductivity across axis 3", "W/(K m)", false, positive()}, "conductivity"},
      {{"k33", "thermal conductivity along axis 3", "W/(K m)", false, positive()}, "conductivity"},
      {{"density", "rho", "kg/m^3", false, positive()}, ""},
      {{"specific_heat", "c_v; the heat capacity of (6) is rho c_v / theta_ref", "J/(kg K)", false,
        positive()},
       ""},
      {{"reference_temperature",
        "theta_ref, the absolute temperature that all others are "
        "differences to",
        "K", false, positive()},
       ""},
  };
  return all;
}

void declare_constants(Visitor &v, MaterialCase &material) {
  for (const Constant &constant : named_constants()) {
    const auto entry = material.constants.find(constant.key.name);
    std::optional<double> value;
    if (entry != material.constants.end())
      value = entry->second;
    v.optional(constant.key, value);
    if (value)
      material.constants[constant.key.name] = *value;
  }
  v.refuse("c66",
           "not a constant of its own: it is (c11 - c12)/2 in a material that is isotropic "
           "about axis 3; other materials are given by `stiffness`");
}

void declare_mechanical_tensors(Visitor &v, MaterialCase &material) {
  v.optional(
      {.name = "stiffness",
       .description = "F, instead of c11, ...: rows and columns in the Voigt order 11, 22, 33, "
                      "23, 13, 12, at constant electric field and temperature",
       .unit = "Pa",
       .length = {{6}, "one for each Voigt index"},
       .rows = 6},
      material.stiffness);
  v.optional({.name = "piezoelectric",
              .description = "E, instead of e31, ...: a row for each axis of the field, columns in "
                             "Voigt order (for engineering shear strains)",
              .unit = "C/m^2",
              .length = {{6}, "one for each Voigt index"},
              .rows = 3},
             material.piezoelectric);
  v.optional(
      {.name = "thermal_stress",
       .description = "M, instead of m11, ..., in Voigt order; positive when heating a clamped "
                      "body compresses it",
       .unit = "N/(K m^2)",
       .length = {{6}, "one for each Voigt index"}},
      material.thermal_stress);
}

void declare_other_tensors(Visitor &v, MaterialCase &material, int dimension) {
  v.optional({.name = "permittivity",
              .description = "beta, instead of beta11, ..., at constant strain",
              .unit = "C/(V m)",
              .length = {{3}, "one for each crystal axis"},
              .rows = 3},
             material.permittivity);
  // In the plane of the axes 1 and 3 nobody wants to write the second entry.
  const Length pyroelectric = dimension == 2 ? Length{{2, 3}, "[p1, p3] or [p1, p2, p3]"}
                                             : Length{{3}, "one for each crystal axis"};
  v.optional(
      {.name = "pyroelectric",
       .description = "P, instead of p3, at constant strain: [p1, p2, p3], in two dimensions "
                      "also [p1, p3]",
       .unit = "C/(K m^2)",
       .length = pyroelectric},
      material.pyroelectric);
  v.optional({.name = "conductivity",
              .description = "K, instead of k11, ...",
              .unit = "W/(K m)",
              .length = {{3}, "one for each crystal axis"},
              .rows = 3},
             material.conductivity);
}

bool has_tensor(const MaterialCase &material, const std::string &name) {
  return (name == "stiffness" && material.stiffness) ||
         (name == "piezoelectric" && material.piezoelectric) ||
         (name == "permittivity" && material.permittivity) ||
         (name == "thermal_stress" && material.thermal_stress) ||
         (name == "pyroelectric" && material.pyroelectric) ||
         (name == "conductivity" && material.conductivity);
}

void check_given_once(Visitor &v, const MaterialCase &material) {
  for (const Constant &constant : named_constants())
    v.check(constant.key.name, [&]() -> std::string {
      if (!material.constants.contains(constant.key.name) || !has_tensor(material, constant.tensor))
        return "";
      return fmt::format("given twice, here and in `{}`", constant.tensor);
    });
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

// `poling` as given, or the last axis, which is its default.
std::vector<double> poling_of(const MaterialCase &material, int dimension) {
  if (!material.poling.empty())
    return material.poling;
  std::vector<double> last(static_cast<std::size_t>(dimension), 0.0);
  last.back() = 1;
  return last;
}

std::string axis_complaint(const MaterialCase &material, int dimension) {
  if (material.axis1.empty())
    return "";
  if (const std::string text = direction_complaint(material.axis1); !text.empty())
    return text;
  const std::vector<double> poling = poling_of(material, dimension);
  double along = 0;
  for (std::size_t i = 0; i < poling.size(); ++i)
    along += poling[i] / length_of(poling) * material.axis1[i] / length_of(material.axis1);
  return std::abs(along) < 1 - 1e-12 ? "" : "is parallel to the poling axis, which is axis 3";
}

void declare_orientation(Visitor &v, MaterialCase &material, int dimension) {
  v.key({.name = "poling",
         .description = "direction of the crystal's axis 3",
         .length = one_each_axis(dimension),
         .default_words = "y in 2D, z in 3D"},
        &material.poling);
  v.key({.name = "axis1",
         .description =
             "direction of the crystal's axis 1, made orthogonal to `poling`; matters only "
             "for crystals that are not isotropic about axis 3",
         .length = one_each_axis(dimension),
         .default_words = "x, or any direction when x is the poling axis"},
        &material.axis1);
  v.check("poling", [&] { return direction_complaint(material.poling); });
  v.check("axis1", [&] { return axis_complaint(material, dimension); });
}

}  // namespace

void declare(Visitor &v, MaterialCase &material, int dimension) {
  v.optional({.name = "library",
              .description = "entry of the built-in library (`tourmaline materials` lists them); a "
                             "constant that is given as well overrides the entry's"},
             material.library);
  declare_constants(v, material);
  declare_mechanical_tensors(v, material);
  declare_other_tensors(v, material, dimension);
  check_given_once(v, material);
  declare_orientation(v, material, dimension);
}

}  // namespace tourmaline::casefile
