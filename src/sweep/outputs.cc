#include "tourmaline/sweep/outputs.h"

#include <algorithm>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>

#include "tourmaline/case/nearest.h"
#include "tourmaline/case/toml_text.h"
#include "tourmaline/error.h"
#include "tourmaline/report/table.h"
#include "tourmaline/report/text_file.h"

namespace tourmaline::sweep {

namespace {

const char *const axes[] = {"x", "y", "z"};

/// The three fields that have extremes.
const std::vector<Output> &fields() {
  static const std::vector<Output> all{
      {"displacement", "m"}, {"potential", "V"}, {"temperature", "K"}};
  return all;
}

class List {
 public:
  std::vector<Output> all;

  void add(const std::string &unit, const std::vector<std::string> &names) {
    for (const std::string &name : names)
      if (std::none_of(all.begin(), all.end(), [&](const Output &o) { return o.name == name; }))
        all.push_back({name, unit});
  }
  void add_each(const std::string &prefix, const std::vector<std::string> &names,
                const std::string &unit) {
    for (const std::string &name : names)
      add(unit, {prefix + name});
  }
};

// Boundaries through which charge or heat may flow, as solve/balance.h has them.
void add_flows(const casefile::Case &asked, List &list) {
  for (const casefile::BoundaryCase &boundary : asked.boundaries) {
    if (boundary.potential || boundary.surface_charge)
      list.add_each("charge_", boundary.on, "C");
    if (boundary.temperature || boundary.heat_flux)
      list.add_each("heat_", boundary.on, "W");
  }
  if (asked.contact && asked.contact->heat.law == "exchange")
    list.add_each("heat_", asked.contact->on, "W");
  for (const casefile::ElectrodeCase &electrode : asked.electrodes) {
    const std::string name = "electrode_" + electrode.name;
    list.add("V", {name + "_voltage"});
    list.add("C", {name + "_charge"});
    list.add("A", {name + "_current"});
  }
}

void add_extremes(int dimension, List &list) {
  for (const Output &field : fields())
    list.add(field.unit, {"min_" + field.name, "max_" + field.name});
  for (const Output &field : fields())
    for (int c = 0; c < dimension; ++c)
      for (const char *which : {"min_", "max_"})
        list.add("m", {"at_" + (which + field.name) + "_" + axes[c]});
}

}  // namespace

std::vector<Output> outputs_of(const casefile::Case &asked) {
  List list;
  list.add("", {"step"});
  list.add("s", {"time"});
  list.add("", {"newton_iterations", "residual", "stick", "slip", "open"});
  list.add("J", {"elastic_energy", "electric_energy", "thermal_energy", "coupling_energy"});
  list.add("W", {"stored_energy_rate", "load_power", "electric_power", "thermal_power",
                 "friction_dissipation", "conduction_loss", "time_step_loss"});
  for (int c = 0; c < asked.dimension; ++c)
    for (const char *force : {"load_", "reaction_", "contact_force_"})
      list.add("N", {std::string(force) + axes[c]});
  add_flows(asked, list);
  list.add("W", {"stored_heat_rate", "heat_source"});
  list.add("", {"energy_imbalance", "force_imbalance", "charge_imbalance", "heat_imbalance"});
  add_extremes(asked.dimension, list);
  return list.all;
}

namespace {

std::vector<std::string> usual_names(const std::vector<casefile::Case> &cases) {
  std::vector<std::string> names{"max_displacement", "min_potential", "max_potential",
                                 "min_temperature", "max_temperature"};
  if (std::any_of(cases.begin(), cases.end(), [](const auto &one) { return one.contact; }))
    names.insert(names.begin(), "slip");
  return names;
}

std::vector<Output> possible_outputs(const std::vector<casefile::Case> &cases) {
  List list;
  for (const casefile::Case &one : cases)
    for (const Output &output : outputs_of(one))
      list.add(output.unit, {output.name});
  return list.all;
}

}  // namespace

std::vector<Output> chosen_outputs(const std::vector<std::string> &names,
                                   const std::vector<casefile::Case> &cases) {
  const std::vector<Output> possible = possible_outputs(cases);
  std::vector<std::string> all(possible.size());
  std::transform(possible.begin(), possible.end(), all.begin(),
                 [](const Output &output) { return output.name; });
  std::vector<Output> chosen;
  for (const std::string &name : names.empty() ? usual_names(cases) : names) {
    const auto found = std::find(all.begin(), all.end(), name);
    if (found == all.end())
      throw CaseError("--output " + casefile::shortened(name) +
                      ": no column of history.csv and no place of an extreme is called so" +
                      casefile::did_you_mean(name, all));
    if (std::any_of(chosen.begin(), chosen.end(), [&](const auto &o) { return o.name == name; }))
      throw CaseError("--output " + name + ": is asked for twice");
    chosen.push_back(possible[static_cast<std::size_t>(found - all.begin())]);
  }
  return chosen;
}

namespace {

// by name, the coordinates of the extremes
std::map<std::string, double> places_in(const std::filesystem::path &file) {
  std::map<std::string, double> places;
  const auto summary = nlohmann::json::parse(report::read_text_file(file), nullptr, false);
  if (!summary.is_object() || !summary.contains("extremes"))
    throw CaseError(file.string() + ": is no summary of a run");
  for (const auto &extreme : summary["extremes"])
    for (const char *which : {"minimum", "maximum"}) {
      const auto &place = extreme.at(std::string("at_") + which);
      for (std::size_t c = 0; c < place.size(); ++c)
        places["at_" + std::string(which).substr(0, 3) + "_" +
               extreme.at("field").get<std::string>() + "_" + axes[c]] = place[c].get<double>();
    }
  return places;
}

}  // namespace

std::vector<double> read_outputs(const std::filesystem::path &folder,
                                 const std::vector<Output> &outputs) {
  const report::Table history = report::read_table(folder / "history.csv");
  const std::map<std::string, double> places = places_in(folder / "summary.json");
  std::vector<double> values;
  for (const Output &output : outputs) {
    const std::vector<double> *column = history.find(output.name);
    const auto place = places.find(output.name);
    values.push_back(column && !column->empty() ? column->back()
                     : place != places.end()    ? place->second
                                                : std::numeric_limits<double>::quiet_NaN());
  }
  return values;
}

}  // namespace tourmaline::sweep
