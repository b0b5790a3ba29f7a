#include "material/completeness.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "case/given.h"
#include "case/symmetry.h"
#include "tourmaline/case/material_case.h"

namespace tourmaline::material {

namespace {

using casefile::MaterialCase;

struct Kind {
  const char *name, *words;
  bool needed;
  const char *instead;  ///< other keys that say the same
};

constexpr Kind kinds[] = {
    {"elastic", "elastic constants", true, "or s11, ..., `stiffness` or `compliance`"},
    {"piezoelectric", "piezoelectric constants", false, ""},
    {"permittivity", "permittivity", true, "or eps11, ..., eps11_T, ... or `permittivity`"},
    {"thermal", "thermal expansion or stress", false, ""},
    {"pyroelectric", "pyroelectric constant", false, ""},
    {"conductivity", "thermal conductivity", true, "or `conductivity`"}};

// The keys of a kind in one form: "d" and 6mm are d31, d33, d15.
std::vector<std::string> keys_of(const std::string &kind, const std::string &form,
                                 const std::string &symmetry) {
  const casefile::ClassConstants &has = casefile::constants_of_class(symmetry);
  if (kind == "elastic" && symmetry == "isotropic")
    return {"young", "poisson"};
  if (kind == "pyroelectric")
    return has.polar ? std::vector<std::string>{form == "p_T" ? "p3_T" : "p3"}
                     : std::vector<std::string>{};
  const auto &indices = kind == "elastic"         ? has.elastic
                        : kind == "piezoelectric" ? has.piezoelectric
                                                  : has.diagonal;
  const bool at_constant_stress = form.ends_with("_T");
  const std::string letters = form.substr(0, form.find('_'));
  std::vector<std::string> keys;
  for (const std::string &index : indices)
    keys.push_back(letters + index + (at_constant_stress ? "_T" : ""));
  return keys;
}

const char *usual_form(const std::string &kind) {
  return kind == "elastic" ? "c" : kind == "permittivity" ? "beta" : "k";
}

bool gives_tensor(const MaterialCase &given, const std::string &kind) {
  const auto tensors = casefile::given_tensors(given);
  return std::any_of(tensors.begin(), tensors.end(), [&](const auto &tensor) {
    return tensor.second && casefile::form_of(tensor.first).kind == kind;
  });
}

// One of the constants that say something of the kind; empty: none does. One that its class does
// not have is another mistake.
std::string given_constant(const MaterialCase &given, const std::string &kind) {
  for (const auto &[key, value] : given.constants)
    if (casefile::form_of(key).kind == kind &&
        casefile::absence(given.symmetry.value_or("6mm"), key).empty())
      return key;
  return "";
}

std::vector<std::string> without_given(const std::vector<std::string> &keys,
                                       const MaterialCase &given) {
  std::vector<std::string> missing;
  for (const std::string &key : keys)
    if (!given.constants.contains(key))
      missing.push_back(key);
  return missing;
}

std::vector<std::string> unpublished(const MaterialCase &given, const std::string &kind) {
  std::vector<std::string> keys;
  for (const std::string &key : given.not_given)
    if (casefile::form_of(key).kind == kind)
      keys.push_back(key);
  return keys;
}

constexpr const char *no_published_value = "no published value";

Gap gap_of(const Kind &kind, const MaterialCase &given) {
  Gap gap{kind.name, kind.words, {}, {}};
  if (gives_tensor(given, kind.name))
    return gap;
  const std::string symmetry = given.symmetry.value_or("6mm");
  if (const std::string one = given_constant(given, kind.name); !one.empty()) {
    gap.constants = without_given(keys_of(kind.name, casefile::form_of(one).form, symmetry), given);
    gap.reason = one + " is given; all of this kind and form, or none";
    if (kind.needed)
      gap.reason = one + " is given, and the others of its form are needed";
  } else if (const auto keys = unpublished(given, kind.name); !keys.empty()) {
    gap.constants = keys;
    gap.reason = no_published_value;
  } else if (kind.needed) {
    gap.constants = keys_of(kind.name, usual_form(kind.name), symmetry);
    gap.reason = symmetry == "isotropic" && std::string(kind.name) == "elastic" ? "" : kind.instead;
  }
  return gap;
}

Gap gap_of_scalar(const std::string &name, const std::string &words, const MaterialCase &given) {
  Gap gap{name, words, {}, {}};
  if (given.constants.contains(name))
    return gap;
  gap.constants = {name};
  const auto &not_given = given.not_given;
  if (std::find(not_given.begin(), not_given.end(), name) != not_given.end())
    gap.reason = no_published_value;
  return gap;
}

bool is_electric(const std::string &kind) {
  return kind == "piezoelectric" || kind == "permittivity" || kind == "pyroelectric";
}

}  // namespace

std::vector<Gap> gaps(const MaterialCase &given) {
  std::vector<Gap> all;
  for (const Kind &kind : kinds)
    if (!given.left_out.contains(kind.name) &&
        (!given.conductor.value_or(false) || !is_electric(kind.name)))
      all.push_back(gap_of(kind, given));
  for (const char *scalar : {"density", "specific_heat", "reference_temperature"})
    if (!given.left_out.contains(scalar))
      all.push_back(gap_of_scalar(scalar, "", given));
  std::erase_if(all, [](const Gap &gap) { return gap.constants.empty(); });
  return all;
}

std::vector<std::string> missing_constants(const MaterialCase &given) {
  std::vector<std::string> all;
  for (const Gap &gap : gaps(given))
    all.insert(all.end(), gap.constants.begin(), gap.constants.end());
  return all;
}

std::string missing_words(const MaterialCase &given) {
  std::string text;
  for (const Gap &gap : gaps(given))
    text += fmt::format("{}{}{}{}{}", text.empty() ? "" : "; ", gap.words,
                        gap.words.empty() ? "" : " ", fmt::join(gap.constants, ", "),
                        gap.reason.empty() ? "" : " (" + gap.reason + ")");
  return text;
}

}  // namespace tourmaline::material
