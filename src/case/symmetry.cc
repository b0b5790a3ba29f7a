#include "case/symmetry.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace tourmaline::casefile {

namespace {

bool holds(const std::vector<std::string> &all, const std::string &one) {
  return std::find(all.begin(), all.end(), one) != all.end();
}

// What follows the letters of a constant, without _T: "33" of "eps33_T".
std::string indices_of(const std::string &constant) {
  const std::size_t begin = constant.find_first_of("0123456789");
  return begin == std::string::npos ? "" : constant.substr(begin, 2);
}

}  // namespace

const std::vector<std::string> &symmetry_classes() {
  static const std::vector<std::string> all{"isotropic", "cubic", "6mm", "3m", "32", "mm2"};
  return all;
}

// IEEE Std 176-1987, table 8: independent constants of the classes.
const ClassConstants &constants_of_class(const std::string &symmetry) {
  static const std::map<std::string, ClassConstants> all{
      {"isotropic", {{}, {}, {"11"}, false}},
      {"cubic", {{"11", "12", "44"}, {}, {"11"}, false}},
      {"6mm", {{"11", "12", "13", "33", "44"}, {"31", "33", "15"}, {"11", "33"}, true}},
      {"3m", {{"11", "12", "13", "14", "33", "44"}, {"15", "22", "31", "33"}, {"11", "33"}, true}},
      {"32", {{"11", "12", "13", "14", "33", "44"}, {"11", "14"}, {"11", "33"}, false}},
      {"mm2",
       {{"11", "12", "13", "22", "23", "33", "44", "55", "66"},
        {"31", "32", "33", "24", "15"},
        {"11", "22", "33"},
        true}}};
  return all.at(symmetry);
}

ConstantForm form_of(const std::string &constant) {
  static const std::map<std::string, ConstantForm> whole{
      {"young", {"elastic", "young"}},
      {"poisson", {"elastic", "young"}},
      {"stiffness", {"elastic", "stiffness"}},
      {"compliance", {"elastic", "compliance"}},
      {"piezoelectric", {"piezoelectric", "piezoelectric"}},
      {"strain_coefficients", {"piezoelectric", "strain_coefficients"}},
      {"permittivity", {"permittivity", "permittivity"}},
      {"permittivity_T", {"permittivity", "permittivity_T"}},
      {"thermal_stress", {"thermal", "thermal_stress"}},
      {"thermal_expansion", {"thermal", "thermal_expansion"}},
      {"pyroelectric", {"pyroelectric", "pyroelectric"}},
      {"pyroelectric_T", {"pyroelectric", "pyroelectric_T"}},
      {"conductivity", {"conductivity", "conductivity"}}};
  if (const auto found = whole.find(constant); found != whole.end())
    return found->second;
  static const std::map<std::string, std::string> kind_of{
      {"c", "elastic"},         {"s", "elastic"},        {"e", "piezoelectric"},
      {"d", "piezoelectric"},   {"m", "thermal"},        {"a", "thermal"},
      {"beta", "permittivity"}, {"eps", "permittivity"}, {"p", "pyroelectric"},
      {"k", "conductivity"}};
  const std::size_t digit = constant.find_first_of("0123456789");
  const std::string letters = constant.substr(0, digit);
  const auto kind = kind_of.find(letters);
  if (digit == std::string::npos || kind == kind_of.end())
    return {};
  return {kind->second, letters + (constant.ends_with("_T") ? "_T" : "")};
}

namespace {

bool has_constant(const std::string &symmetry, const std::string &constant) {
  const ClassConstants &has = constants_of_class(symmetry);
  const ConstantForm form = form_of(constant);
  if (form.form == "young")
    return symmetry == "isotropic";
  if (form.kind == "elastic")
    return holds(has.elastic, indices_of(constant));
  if (form.kind == "piezoelectric")
    return holds(has.piezoelectric, indices_of(constant));
  if (form.kind == "pyroelectric")
    return has.polar;
  return form.kind.empty() || holds(has.diagonal, indices_of(constant));
}

}  // namespace

std::string absence(const std::string &symmetry, const std::string &constant) {
  if (has_constant(symmetry, constant))
    return "";
  if (constant == "c66" || constant == "s66")
    return fmt::format(
        "not a constant of its own in class {}: isotropic about axis 3 it is {}; `symmetry` names "
        "the class",
        symmetry, constant == "c66" ? "(c11 - c12)/2" : "2 (s11 - s12)");
  return fmt::format(
      "no constant of class {}; `symmetry` names the class, and tensors given as a whole have any",
      symmetry);
}

}  // namespace tourmaline::casefile
