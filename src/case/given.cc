#include "case/given.h"

#include <set>
#include <utility>

#include "case/symmetry.h"
#include "tourmaline/case/material_case.h"

namespace tourmaline::casefile {

namespace {

// The same for all tensors: `visit(key, tensor of one, tensor of other)`.
template <class One, class Other, class Visit>
void for_each_tensor(One &one, Other &other, const Visit &visit) {
  visit("stiffness", one.stiffness, other.stiffness);
  visit("compliance", one.compliance, other.compliance);
  visit("piezoelectric", one.piezoelectric, other.piezoelectric);
  visit("strain_coefficients", one.strain_coefficients, other.strain_coefficients);
  visit("permittivity", one.permittivity, other.permittivity);
  visit("permittivity_T", one.permittivity_T, other.permittivity_T);
  visit("thermal_stress", one.thermal_stress, other.thermal_stress);
  visit("thermal_expansion", one.thermal_expansion, other.thermal_expansion);
  visit("pyroelectric", one.pyroelectric, other.pyroelectric);
  visit("pyroelectric_T", one.pyroelectric_T, other.pyroelectric_T);
  visit("conductivity", one.conductivity, other.conductivity);
}

using Forms = std::set<std::pair<std::string, std::string>>;  // kind and form

Forms forms_in(const MaterialCase &material) {
  Forms forms;
  const auto add = [&](const std::string &key) {
    if (const ConstantForm form = form_of(key); !form.kind.empty())
      forms.emplace(form.kind, form.form);
  };
  for (const auto &[key, value] : material.constants)
    add(key);
  for (const auto &[key, given] : given_tensors(material))
    if (given)
      add(key);
  return forms;
}

// Whether the forms say something of the key's kind, but in another form.
bool replace(const Forms &forms, const std::string &key) {
  const ConstantForm own = form_of(key);
  for (const auto &[kind, form] : forms)
    if (kind == own.kind && form != own.form)
      return true;
  return false;
}

}  // namespace

std::map<std::string, bool> given_tensors(const MaterialCase &material) {
  std::map<std::string, bool> given;
  for_each_tensor(material, material, [&](const char *key, const auto &tensor, const auto &) {
    given[key] = tensor.has_value();
  });
  return given;
}

MaterialCase merged(const MaterialCase &entry, const MaterialCase &over) {
  MaterialCase all = entry;
  const Forms forms = forms_in(over);
  std::erase_if(all.constants,
                [&](const auto &constant) { return replace(forms, constant.first); });
  for (const auto &[key, value] : over.constants)
    all.constants[key] = value;
  for_each_tensor(all, over, [&](const char *key, auto &mine, const auto &others) {
    if (others)
      mine = others;
    else if (replace(forms, key))
      mine.reset();
  });
  if (over.symmetry)
    all.symmetry = over.symmetry;
  if (over.conductor)
    all.conductor = over.conductor;
  all.where = over.where;
  all.library = over.library;
  all.file = over.file;
  all.poling = over.poling;
  all.axis1 = over.axis1;
  return all;
}

MaterialCase without_left_out(MaterialCase material) {
  const auto is_left_out = [&](const std::string &key) {
    return material.left_out.contains(form_of(key).kind);
  };
  std::erase_if(material.constants,
                [&](const auto &constant) { return is_left_out(constant.first); });
  for_each_tensor(material, material, [&](const char *key, auto &tensor, const auto &) {
    if (is_left_out(key))
      tensor.reset();
  });
  return material;
}

}  // namespace tourmaline::casefile
