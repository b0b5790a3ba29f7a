#include "case/electrodes.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>

#include "case/conflicts.h"
#include "case/nearest.h"
#include "case/place_of_key.h"
#include "case/toml_text.h"
#include "tourmaline/case/case.h"
#include "tourmaline/error.h"

namespace tourmaline::casefile {

namespace {

[[noreturn]] void fail(const ElectrodeCase &electrode, const std::string &reason) {
  throw CaseError(fmt::format("{} {}: {}", electrode.where, toml_text(electrode.name), reason));
}

// At one of its keys.
[[noreturn]] void fail(const ElectrodeCase &electrode, const std::string &key,
                       const std::string &value, const std::string &reason) {
  throw CaseError(fmt::format("{} = {}: {}", place_of_key(electrode.places, electrode.where, key),
                              value, reason));
}

std::string toml_of(const std::optional<Formula> &formula) {
  return formula->is_number() ? formula->text() : toml_text(formula->text());
}

void check_name(const ElectrodeCase &electrode) {
  const auto allowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-';
  };
  if (electrode.name.empty() || !std::all_of(electrode.name.begin(), electrode.name.end(), allowed))
    fail(electrode, "name", toml_text(electrode.name),
         "must consist of letters, digits, _ and -, as columns are named by it");
}

void check_alone(const ElectrodeCase &electrode) {
  if (electrode.charge && (electrode.voltage || electrode.is_loaded()))
    fail(electrode, "charge", toml_of(electrode.charge),
         "its charge is given, so neither a voltage nor a resistor or capacitor can be");
  if (electrode.to && !electrode.is_loaded())
    fail(electrode, "to", toml_text(*electrode.to),
         "says where a resistor or capacitor leads, but there is none");
  if (electrode.to && electrode.voltage)
    fail(electrode, "to", toml_text(*electrode.to),
         "`to` and `voltage` both say where its resistor or capacitor leads; give one");
  for (const auto *formula : {&electrode.voltage, &electrode.charge})
    if (*formula && (*formula)->depends_on_place())
      throw CaseError(
          fmt::format("{} = {}: depends on the place; an electrode has one value, "
                      "which may depend on t only",
                      (*formula)->where(), toml_of(*formula)));
}

// The names that `to` may have, and which of them is nearest.
std::string others_words(const ElectrodeCase &electrode, const std::vector<ElectrodeCase> &all) {
  std::vector<std::string> names;
  for (const ElectrodeCase &other : all)
    if (other.name != electrode.name)
      names.push_back(other.name);
  if (names.empty())
    return "; there is no other electrode";
  return fmt::format("; there are {}{}", fmt::join(names, ", "),
                     did_you_mean(*electrode.to, names));
}

void check_to(const ElectrodeCase &electrode, const std::vector<ElectrodeCase> &all) {
  if (!electrode.to)
    return;
  const std::string to = toml_text(*electrode.to);
  const auto other = std::find_if(
      all.begin(), all.end(), [&](const ElectrodeCase &one) { return one.name == *electrode.to; });
  if (other == all.end())
    fail(electrode, "to", to, "names no electrode" + others_words(electrode, all));
  if (&*other == &electrode)
    fail(electrode, "to", to, "is the electrode itself" + others_words(electrode, all));
  if (other->charge)
    fail(electrode, "to", to, "names an electrode whose charge is given and cannot flow");
}

// One search for potentials at a time.
void check_searches(const Case &asked) {
  const bool searches = asked.solver.method == "monolithic" || asked.solver.body == "iterative";
  const auto free = std::find_if(asked.electrodes.begin(), asked.electrodes.end(),
                                 [](const ElectrodeCase &one) { return !one.is_driven(); });
  if (!searches || free == asked.electrodes.end())
    return;
  for (const ContactCase &contact : asked.contacts)
    if (contact.electric.circuit)
      fail(*free,
           fmt::format("electrodes whose voltage is not given are not available with {} where a "
                       "foundation has a circuit, too; use solver.method = \"condensed\" and "
                       "solver.body = \"direct\"",
                       asked.solver.method == "monolithic" ? "solver.method = \"monolithic\""
                                                           : "solver.body = \"iterative\""));
}

// Two on one facet would both be said to have its voltage.
void check_apart(const ElectrodeCase &electrode, const MeshCase &mesh,
                 std::map<std::string, const ElectrodeCase *> &by_part) {
  for (const std::string &boundary : electrode.on)
    for (const std::string &part : parts_of_boundary(mesh, boundary))
      if (const ElectrodeCase *first = by_part.try_emplace(part, &electrode).first->second;
          first != &electrode)
        fail(
            electrode, "on", toml_text(boundary),
            "there is an electrode already, by " + place_of_key(first->places, first->where, "on"));
}

}  // namespace

void check_electrodes(const Case &asked) {
  std::map<std::string, std::string> by_name;  // where it was said first
  std::map<std::string, const ElectrodeCase *> by_part;
  for (const ElectrodeCase &electrode : asked.electrodes) {
    check_name(electrode);
    check_alone(electrode);
    check_to(electrode, asked.electrodes);
    if (const auto [first, is_new] = by_name.try_emplace(
            electrode.name, place_of_key(electrode.places, electrode.where, "name"));
        !is_new)
      fail(electrode, "name", toml_text(electrode.name),
           "this name has already been given at " + first->second);
    check_apart(electrode, asked.mesh, by_part);
  }
  check_searches(asked);
}

bool all_voltages_given(const Case &asked) {
  return std::all_of(asked.electrodes.begin(), asked.electrodes.end(),
                     [](const ElectrodeCase &electrode) { return electrode.is_driven(); });
}

}  // namespace tourmaline::casefile
