#include "case/electrodes.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "case/nearest.h"
#include "case/toml_text.h"
#include "tourmaline/case/case.h"
#include "tourmaline/error.h"

namespace tourmaline::casefile {

namespace {

[[noreturn]] void fail(const ElectrodeCase &electrode, const std::string &reason) {
  throw CaseError(fmt::format("{} {}: {}", electrode.where, toml_text(electrode.name), reason));
}

void check_name(const ElectrodeCase &electrode) {
  const auto allowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-';
  };
  if (electrode.name.empty() || !std::all_of(electrode.name.begin(), electrode.name.end(), allowed))
    fail(electrode,
         "the name must consist of letters, digits, _ and -, as columns are named by it");
}

void check_alone(const ElectrodeCase &electrode) {
  if (electrode.charge && (electrode.voltage || electrode.is_loaded()))
    fail(electrode, "its charge is given, so neither a voltage nor a resistor or capacitor can be");
  if (electrode.to && !electrode.is_loaded())
    fail(electrode, "`to` says where a resistor or capacitor leads, but there is none");
  if (electrode.to && electrode.voltage)
    fail(electrode, "`to` and `voltage` both say where its resistor or capacitor leads; give one");
  for (const auto *formula : {&electrode.voltage, &electrode.charge})
    if (*formula && (*formula)->depends_on_place())
      fail(electrode, fmt::format("{} = {} depends on the place; an electrode has one value, which "
                                  "may depend on t only",
                                  (*formula)->where(), toml_text((*formula)->text())));
}

void check_to(const ElectrodeCase &electrode, const std::vector<ElectrodeCase> &all) {
  if (!electrode.to)
    return;
  std::vector<std::string> names(all.size());
  std::transform(all.begin(), all.end(), names.begin(),
                 [](const ElectrodeCase &other) { return other.name; });
  const auto found = std::find(names.begin(), names.end(), *electrode.to);
  if (found == names.end())
    fail(electrode, fmt::format("`to` names no electrode: {}{}", toml_text(*electrode.to),
                                did_you_mean(*electrode.to, names)));
  const ElectrodeCase &other = all[static_cast<std::size_t>(found - names.begin())];
  if (&other == &electrode)
    fail(electrode, "`to` is the electrode itself");
  if (other.charge)
    fail(electrode,
         fmt::format("`to` is {}, whose charge is given and cannot flow", toml_text(other.name)));
}

}  // namespace

void check_electrodes(const Case &asked) {
  std::map<std::string, std::string> by_name, by_boundary;  // where it was said first
  for (const ElectrodeCase &electrode : asked.electrodes) {
    check_name(electrode);
    check_alone(electrode);
    check_to(electrode, asked.electrodes);
    if (const auto [first, is_new] = by_name.try_emplace(electrode.name, electrode.where); !is_new)
      fail(electrode, "this name has already been given at " + first->second);
    for (const std::string &boundary : electrode.on)
      if (const auto [first, is_new] = by_boundary.try_emplace(boundary, electrode.where); !is_new)
        fail(electrode, fmt::format("on = \"{}\": there is an electrode already, by {}", boundary,
                                    first->second));
  }
  if (asked.solver.method == "monolithic")
    require_given_voltages(asked, "solver.method = \"monolithic\"");
  if (asked.solver.body == "iterative")
    require_given_voltages(asked, "solver.body = \"iterative\"");
}

bool all_voltages_given(const Case &asked) {
  return std::all_of(asked.electrodes.begin(), asked.electrodes.end(),
                     [](const ElectrodeCase &electrode) { return electrode.is_driven(); });
}

void require_given_voltages(const Case &asked, const std::string &solver) {
  for (const ElectrodeCase &electrode : asked.electrodes)
    if (!electrode.is_driven())
      fail(electrode,
           fmt::format("electrodes whose voltage is not given are not available with {}; use "
                       "solver.method = \"condensed\" and solver.body = \"direct\"",
                       solver));
}

}  // namespace tourmaline::casefile
