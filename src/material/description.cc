#include "material/description.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "case/given.h"
#include "case/symmetry.h"
#include "dense/decompositions.h"
#include "material/completeness.h"
#include "material/constants.h"
#include "material/library.h"
#include "tourmaline/case/material_case.h"
#include "tourmaline/error.h"

namespace tourmaline::material {

namespace {

using casefile::MaterialCase;

const char *unit_of(const std::string &constant) {
  const std::string form = casefile::form_of(constant).form;
  static const std::map<std::string, const char *> units{
      {"c", "Pa"},         {"s", "1/Pa"},       {"e", "C/m^2"},        {"d", "C/N"},
      {"beta", "C/(V m)"}, {"eps", "relative"}, {"eps_T", "relative"}, {"m", "N/(K m^2)"},
      {"a", "1/K"},        {"p", "C/(K m^2)"},  {"p_T", "C/(K m^2)"},  {"k", "W/(K m)"}};
  if (const auto found = units.find(form); found != units.end())
    return found->second;
  if (constant == "density")
    return "kg/m^3";
  if (constant == "specific_heat")
    return "J/(kg K)";
  return constant == "young" ? "Pa" : constant == "poisson" ? "" : "K";
}

template <typename Matrix>
std::string table(const std::string &title, const Matrix &matrix) {
  std::string text = title + "\n";
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    for (Eigen::Index j = 0; j < matrix.cols(); ++j)
      text += fmt::format("{:>12.4g}", std::abs(matrix(i, j)) < 1e-9 * matrix.cwiseAbs().maxCoeff()
                                           ? 0.
                                           : matrix(i, j));
    text += "\n";
  }
  return text;
}

// Both forms of the electromechanical constants (IEEE Std 176-1987, table 4).
struct Forms {
  Stiffness c, s;
  Piezoelectric e, d;
  Tensor strain_free, stress_free;  // permittivity at constant strain and at constant stress

  explicit Forms(const Constants &constants)
      : c(constants.stiffness),
        s(dense::inverse(c)),
        e(constants.piezoelectric),
        d(e * s),
        strain_free(constants.permittivity),
        stress_free(strain_free + d * e.transpose()) {}
};

constexpr double vacuum = 8.8541878128e-12;  // CODATA 2018 [C/(V m)]

std::string both_forms(const Forms &f) {
  std::string text =
      "\nStress-charge form, crystal axes, Voigt order 11 22 33 23 13 12 (constant strain):\n";
  text += table("stiffness c^E [Pa]", f.c) + table("piezoelectric e [C/m^2]", f.e) +
          table("relative permittivity eps^S", (f.strain_free / vacuum).eval());
  text += "\nStrain-charge form (constant stress):\n";
  text += table("compliance s^E [1/Pa]", f.s) + table("piezoelectric d [C/N]", f.d) +
          table("relative permittivity eps^T", (f.stress_free / vacuum).eval());
  return text;
}

struct Factor {
  std::string name, meaning;
  double square;
};

// IEEE Std 176-1987, table 9, for a crystal whose axis 3 is the poling axis.
std::vector<Factor> coupling_factors(const Forms &f, bool round) {
  const double e33 = f.e(2, 2), stiffened = f.c(2, 2) + e33 * e33 / f.strain_free(2, 2);
  std::vector<Factor> all{
      {"k33", "bar along axis 3", f.d(2, 2) * f.d(2, 2) / (f.s(2, 2) * f.stress_free(2, 2))},
      {"k31", "bar across axis 3", f.d(2, 0) * f.d(2, 0) / (f.s(0, 0) * f.stress_free(2, 2))},
      {"k15", "shear", f.d(0, 4) * f.d(0, 4) / (f.s(4, 4) * f.stress_free(0, 0))},
      {"kt", "plate in thickness", e33 * e33 / (f.strain_free(2, 2) * stiffened)}};
  if (round)
    all.push_back({"kp", "thin disc",
                   2 * f.d(2, 0) * f.d(2, 0) / ((f.s(0, 0) + f.s(0, 1)) * f.stress_free(2, 2))});
  return all;
}

std::string couplings(const Forms &f, bool round) {
  std::string text = "\nCoupling factors:\n";
  for (const Factor &factor : coupling_factors(f, round))
    text +=
        fmt::format("{:<4} {:.3f}  {}\n", factor.name, std::sqrt(factor.square), factor.meaning);
  return text;
}

std::string thermal(const MaterialCase &given) {
  const Constants c = constants_of(given);
  const Voigt expansion = dense::solve(c.stiffness, c.thermal_stress);
  std::string text = "\nThermal constants:\n";
  text +=
      table("thermal stress M [N/(K m^2)]", c.thermal_stress.transpose().eval()) +
      table("thermal expansion [1/K]", expansion.transpose().eval()) +
      table("pyroelectric p at constant strain [C/(K m^2)]", c.pyroelectric.transpose().eval()) +
      table("pyroelectric p at constant stress [C/(K m^2)]",
            (c.pyroelectric + c.piezoelectric * expansion).transpose().eval()) +
      table("conductivity [W/(K m)]", c.conductivity);
  return text;
}

std::string with_unit(const std::string &constant) {
  const std::string unit = unit_of(constant);
  return constant + (unit.empty() ? "" : " [" + unit + "]");
}

// What a case must add, a line for each kind.
std::string to_add(const MaterialCase &given) {
  std::string text;
  for (const Gap &gap : gaps(given)) {
    std::string keys;
    for (const std::string &constant : gap.constants)
      keys += (keys.empty() ? "" : ", ") + with_unit(constant);
    text += fmt::format("  {}{}{}{}\n", gap.words.empty() ? "" : gap.words + ": ", keys,
                        gap.reason.empty() ? "" : "; ", gap.reason);
  }
  return text.empty() ? ""
                      : "\nDoes not run as it is; beside `library` a case must give:\n" + text +
                            "but nothing that belongs to a field that it leaves out (`thermal = "
                            "false` or `electric = false` in [model])\n";
}

std::string warnings(const MaterialCase &given, const std::optional<Forms> &forms) {
  std::string text;
  if (forms)
    for (const Factor &factor : coupling_factors(*forms, given.symmetry.value_or("6mm") == "6mm"))
      if (factor.square > 0.9)
        text += fmt::format("{} = {:.3f} is close to 1: check signs and units\n", factor.name,
                            std::sqrt(factor.square));
  return text.empty() ? "" : "\nWarnings:\n" + text;
}

std::string constants(const MaterialCase &given) {
  std::string text;
  for (const auto &[constant, value] : given.constants)
    text += fmt::format("{:<22}{:>12g}  {}\n", constant, value, unit_of(constant));
  return text;
}

bool lacks(const MaterialCase &given, const std::set<std::string> &asked) {
  const std::vector<Gap> all = gaps(given);
  return std::any_of(all.begin(), all.end(),
                     [&](const Gap &gap) { return asked.contains(gap.kind); });
}

std::string electromechanical_tensors(const MaterialCase &given) {
  const Constants c = electromechanical(given);
  if (given.conductor.value_or(false))
    return "\n" + table("stiffness [Pa]", c.stiffness);
  const Forms forms(c);
  std::string text = both_forms(forms);
  if (c.piezoelectric.squaredNorm() > 0)
    text += couplings(forms, given.symmetry.value_or("6mm") == "6mm");
  return text + warnings(given, forms);
}

// As far as what is given allows.
std::string tensors(const MaterialCase &asked, const MaterialCase &given) {
  if (lacks(given, {"elastic", "piezoelectric", "permittivity"}))
    return "";
  std::string text;
  try {
    text = electromechanical_tensors(given);
    if (gaps(given).empty())
      text += thermal(asked) + "\nThe material is " + couplings(constants_of(asked)) + ".\n";
  } catch (const CaseError &error) {
    text += fmt::format("\nWarnings:\n{}\n", error.what());
  }
  return text;
}

}  // namespace

namespace {

std::string state_of(const Entry &entry) {
  std::string text;
  if (const auto missing = missing_constants(entry.given); entry.is_read() && !missing.empty())
    text = fmt::format("add {}", fmt::join(missing, ", "));
  if (!entry.mistake.empty())
    text += (text.empty() ? "" : "; ") + ("cannot be used: " + entry.mistake);
  return text.empty() ? "complete" : text;
}

}  // namespace

std::string describe_library(const std::string &file) {
  std::string text;
  for (const Entry &entry : file.empty() ? library() : materials_in(file))
    text += fmt::format("{:<18} {:<10} {:<42} {}\n", entry.name,
                        entry.given.symmetry.value_or("6mm"), state_of(entry), entry.given.source);
  return text;
}

std::string describe(const MaterialCase &asked) {
  const MaterialCase given = with_entry(asked);
  std::string text = fmt::format(
      "{}\n{}\nclass {}{}\n\n", *asked.library, given.source, given.symmetry.value_or("6mm"),
      given.conductor.value_or(false) ? ", a conductor: no electric field inside" : "");
  return text + constants(given) + tensors(asked, given) + to_add(given);
}

namespace {

using Json = nlohmann::ordered_json;

Json as_json(const Entry &entry) {
  const MaterialCase &given = entry.given;
  Json json{{"name", entry.name},
            {"source", given.source},
            {"symmetry", given.symmetry.value_or("6mm")},
            {"conductor", given.conductor.value_or(false)},
            {"constants", given.constants},
            {"tensors", Json::array()},
            {"complete", gaps(given).empty() && entry.mistake.empty()},
            {"missing", Json::array()}};
  if (!entry.mistake.empty())
    json["mistake"] = entry.mistake;
  for (const auto &[key, is_given] : casefile::given_tensors(given))
    if (is_given)
      json["tensors"].push_back(key);
  const bool is_known = entry.is_read() || entry.mistake.empty();
  for (const Gap &gap : is_known ? gaps(given) : std::vector<Gap>{})
    for (const std::string &constant : gap.constants)
      json["missing"].push_back(
          {{"key", constant}, {"unit", unit_of(constant)}, {"reason", gap.reason}});
  return json;
}

std::string printed(const Json &json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace

std::string library_json(const std::string &file) {
  Json all = Json::array();
  for (const Entry &entry : file.empty() ? library() : materials_in(file))
    all.push_back(as_json(entry));
  return printed(all);
}

std::string entry_json(const MaterialCase &asked) {
  return printed(as_json({*asked.library, with_entry(asked), ""}));
}

}  // namespace tourmaline::material
