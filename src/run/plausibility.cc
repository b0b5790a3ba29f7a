#include "run/plausibility.h"

#include <fmt/format.h>

#include <algorithm>

#include "body/derived.h"
#include "case/toml_text.h"
#include "material/constants.h"
#include "material/coupling.h"
#include "run/survey.h"

namespace tourmaline::run {

namespace {

// Relaxor crystals, the most strongly coupled materials, have factors of 0.95. Nearly
// incompressible rubber beside steel has 1e4 between the materials; the usual slips, MPa and GPa,
// make 1e6 and 1e9.
constexpr double largest_coupling = 0.98, largest_ratio_inside = 1e4, largest_ratio_between = 1e5,
                 largest_strain = 0.1;

// Of known materials: relaxors have 1e5 times the permittivity of vacuum, foams 30 kg/m^3. Below 50
// K there are experiments, but far more people who think in degrees Celsius.
constexpr double vacuum_permittivity = 8.8541878128e-12;  // CODATA 2018 [C/(V m)]
constexpr double largest_permittivity = 1e-6, least_density = 30, least_reference = 50;

constexpr const char *units =
    "check the units: stiffness in Pa (1 GPa = 1e9 Pa), d in C/N (1 pC/N = 1e-12 C/N), e in C/m^2";

struct Part {
  std::string name;
  material::Constants constants;
  bool is_isotropic;

  auto diagonal() const { return constants.stiffness.diagonal(); }
};

std::vector<Part> parts_of(const casefile::Case &asked) {
  const std::vector<output::MaterialRecord> records = materials_of(asked);
  const std::vector<casefile::MaterialCase> materials = material::materials_of(asked);
  std::vector<Part> parts;
  for (std::size_t i = 0; i < records.size(); ++i) {
    const bool whole = asked.regions.empty();
    const casefile::MaterialCase given = material::with_entry(materials[i]);
    parts.push_back({(whole ? "" : "region " + casefile::toml_text(records[i].region) + ", ") +
                         records[i].material,
                     material::constants_of(given), given.symmetry == "isotropic"});
  }
  return parts;
}

std::string coupling_warning(const Part &part) {
  if (part.constants.conductor)
    return "";
  const double factor = material::coupling_factor(part.constants);
  return factor <= largest_coupling
             ? ""
             : fmt::format(
                   "{}: the electromechanical coupling factor is {:.6g}, and no known material "
                   "reaches {}; {}",
                   part.name, factor, largest_coupling, units);
}

// Of an isotropic material one constant has a unit; the other makes rubber incompressible.
std::string ratio_warning(const Part &part) {
  Eigen::Index most = 0, least = 0;
  const double largest = part.diagonal().maxCoeff(&most),
               smallest = part.diagonal().minCoeff(&least);
  if (part.is_isotropic || largest <= largest_ratio_inside * smallest)
    return "";
  return fmt::format("{}: the stiffness c{}{} = {:.4g} Pa is {:.2g} times c{}{} = {:.4g} Pa; {}",
                     part.name, most + 1, most + 1, largest, largest / smallest, least + 1,
                     least + 1, smallest, units);
}

std::string permittivity_warning(const Part &part) {
  const double largest = part.constants.permittivity.diagonal().maxCoeff();
  if (part.constants.conductor || largest <= largest_permittivity)
    return "";
  return fmt::format(
      "{}: a permittivity of {:.4g} C/(V m) is {:.2g} times that of vacuum; relative "
      "permittivities "
      "are given as eps11, ..., and beta11, ... or `permittivity` in C/(V m)",
      part.name, largest, largest / vacuum_permittivity);
}

std::string density_warning(const Part &part) {
  return part.constants.density >= least_density
             ? ""
             : fmt::format(
                   "{}: the density {:g} kg/m^3 is less than that of a foam; check the unit "
                   "(1 g/cm^3 = 1000 kg/m^3)",
                   part.name, part.constants.density);
}

std::string reference_warning(const Part &part) {
  return part.constants.reference_temperature >= least_reference
             ? ""
             : fmt::format(
                   "{}: the reference temperature is {:g} K; check the unit, it is absolute "
                   "(20 degrees Celsius = 293 K)",
                   part.name, part.constants.reference_temperature);
}

std::string contrast_warning(const std::vector<Part> &parts) {
  const auto [soft, stiff] =
      std::minmax_element(parts.begin(), parts.end(), [](const Part &a, const Part &b) {
        return a.diagonal().maxCoeff() < b.diagonal().maxCoeff();
      });
  const double ratio = stiff->diagonal().maxCoeff() / soft->diagonal().maxCoeff();
  return ratio <= largest_ratio_between ? ""
                                        : fmt::format("{} is {:.2g} times as stiff as {}; {}",
                                                      stiff->name, ratio, soft->name, units);
}

void add(const std::string &warning, std::vector<std::string> &all) {
  if (!warning.empty() && std::find(all.begin(), all.end(), warning) == all.end())
    all.push_back(warning);
}

}  // namespace

std::vector<std::string> material_warnings(const casefile::Case &asked) {
  const std::vector<Part> parts = parts_of(asked);
  std::vector<std::string> all;
  for (const Part &part : parts) {
    add(coupling_warning(part), all);
    add(ratio_warning(part), all);
    add(permittivity_warning(part), all);
    add(density_warning(part), all);
    add(reference_warning(part), all);
  }
  add(contrast_warning(parts), all);
  return all;
}

template <int dim>
std::string strain_warning(const solve::Model<dim> &model, const std::vector<Moment> &moments) {
  body::LargestStrain largest;
  const Moment *when = nullptr;
  for (const Moment &moment : moments)
    if (const auto found = body::largest_strain(model.body, moment.state);
        found.size > std::max(largest.size, largest_strain)) {
      largest = found;
      when = &moment;
    }
  if (!when)
    return "";
  std::string place;
  for (int axis = 0; axis < dim; ++axis)
    place += fmt::format("{}{:.4g}", axis == 0 ? "(" : ", ", largest.at[axis]);
  return fmt::format(
      "strains reach {:.2g}, at {}) (step {}, t = {:g} s), and the theory is linear, for strains "
      "far below 1; check the units of loads and material constants",
      largest.size, place, when->step, when->time);
}

template std::string strain_warning<2>(const solve::Model<2> &, const std::vector<Moment> &);
template std::string strain_warning<3>(const solve::Model<3> &, const std::vector<Moment> &);

}  // namespace tourmaline::run
