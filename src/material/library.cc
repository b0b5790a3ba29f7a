#include "tourmaline/material/library.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "tourmaline/case/nearest.h"
#include "tourmaline/error.h"

namespace tourmaline::material {

const std::vector<Entry> &library() {
  static const std::vector<Entry> entries{
      {"BaTiO3-Liu2014",
       "P. Liu et al., Int. J. Solids Struct. 51 (2014) 2167-2182, as used by Ouafik (2020), "
       "section 4. The "
       "pyroelectric constant is p3 = -1e-4 as printed; see docs/paper-notes.md for the sign that "
       "the "
       "paper's figures need. c12 = 77 GPa completes the set in three dimensions.",
       {{"c11", 166e9},
        {"c12", 77e9},
        {"c13", 78e9},
        {"c33", 162e9},
        {"c44", 43e9},
        {"e31", -4.4},
        {"e33", 18.6},
        {"e15", 11.6},
        {"beta11", 11.2e-9},
        {"beta33", 12.6e-9},
        {"m11", 2.24e6},
        {"m33", 1.89e6},
        {"p3", -1e-4},
        {"k11", 50},
        {"k33", 75},
        {"density", 5500},
        {"specific_heat", 420},
        {"reference_temperature", 293}}}};
  return entries;
}

const Entry &find(const std::string &name) {
  std::vector<std::string> names;
  for (const Entry &entry : library()) {
    if (entry.name == name)
      return entry;
    names.push_back(entry.name);
  }
  throw CaseError(
      fmt::format("[material] library = \"{}\": no such material; did you mean \"{}\"? "
                  "`tourmaline materials` lists them",
                  name, casefile::nearest(name, names).value_or(names.front())));
}

std::string describe_library() {
  std::string text;
  for (const Entry &entry : library())
    text += fmt::format("{}  {}\n", entry.name, entry.source);
  return text;
}

namespace {

const char *unit_of(const std::string &constant) {
  switch (constant[0]) {
    case 'c':
      return "Pa";
    case 'e':
      return "C/m^2";
    case 'b':
      return "C/(V m)";
    case 'm':
      return "N/(K m^2)";
    case 'p':
      return "C/(K m^2)";
    case 'k':
      return "W/(K m)";
    case 'd':
      return "kg/m^3";
    case 's':
      return "J/(kg K)";
    default:
      return "K";
  }
}

template <typename Matrix>
std::string table(const char *title, const Matrix &matrix) {
  std::ostringstream text;
  text << title << "\n" << matrix << "\n";
  return text.str();
}

}  // namespace

std::string describe(const std::string &name) {
  const Entry &entry = find(name);
  std::string text = fmt::format("{}\n{}\n\n", entry.name, entry.source);
  for (const auto &[constant, value] : entry.constants)
    text += fmt::format("{:<22}{:>12g}  {}\n", constant, value, unit_of(constant));
  casefile::MaterialCase asked;
  asked.library = name;
  const Constants c = constants_of(asked);
  text += "\nStress-charge form at constant strain, crystal axes, Voigt order 11 22 33 23 13 12:\n";
  text += table("stiffness [Pa]", c.stiffness);
  text += table("piezoelectric [C/m^2]", c.piezoelectric);
  text += table("permittivity [C/(V m)]", c.permittivity);
  text += table("thermal stress [N/(K m^2)]", c.thermal_stress.transpose().eval());
  text += table("pyroelectric [C/(K m^2)]", c.pyroelectric.transpose().eval());
  text += table("conductivity [W/(K m)]", c.conductivity);
  return text;
}

}  // namespace tourmaline::material
