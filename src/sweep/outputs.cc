#include "sweep/outputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <iterator>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <utility>

#include "case/nearest.h"
#include "case/toml_text.h"
#include "contact/contacts.h"
#include "output/probe_rows.h"
#include "report/table.h"
#include "report/text_file.h"
#include "tourmaline/case/case.h"
#include "tourmaline/error.h"

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
      if (const auto same =
              std::find_if(all.begin(), all.end(), [&](const Output &o) { return o.name == name; });
          same == all.end())
        all.push_back({name, unit});
      else if (same->unit != unit)  // of bodies in two and in three dimensions
        same->unit += " or " + unit;
  }
  void add_each(const std::string &prefix, const std::vector<std::string> &names,
                const std::string &unit) {
    for (const std::string &name : names)
      add(unit, {prefix + name});
  }
};

/// The unit of what is summed over the body or its boundary.
std::string whole(const std::string &unit, const casefile::Case &asked) {
  return asked.is_per_depth() ? unit + "/m" : unit;
}

// Of all axes, about which contact has a moment: in the plane one, of revolution none.
int first_moment(const casefile::Case &asked) {
  if (asked.model.is_axisymmetric())
    return 3;
  return asked.dimension == 2 ? 2 : 0;
}

// Boundaries through which charge or heat may flow, as solve/balance.h has them.
void add_flows(const casefile::Case &asked, List &list) {
  const std::string charge = whole("C", asked), heat = whole("W", asked);
  for (const casefile::BoundaryCase &boundary : asked.boundaries) {
    if (boundary.potential || boundary.surface_charge)
      list.add_each("charge_", boundary.on, charge);
    if (boundary.temperature || boundary.heat_flux)
      list.add_each("heat_", boundary.on, heat);
  }
  const contact::Contacts laws(asked.contacts, asked.time.end / asked.time.steps);
  for (std::size_t i = 0; i < asked.contacts.size(); ++i) {
    if (laws[i].lets_pass(contact::Crossing::heat))
      list.add_each("heat_", asked.contacts[i].on, heat);
    if (laws[i].lets_pass(contact::Crossing::charge))
      list.add_each("charge_", asked.contacts[i].on, charge);
  }
  for (const casefile::ContactCase &contact : asked.contacts) {
    if (!contact.electric.circuit)
      continue;
    const std::string name = asked.contacts.size() > 1 ? "_" + contact.called() : std::string();
    list.add("V", {"foundation_voltage" + name});
    list.add(charge, {"foundation_charge" + name});
    list.add(whole("A", asked), {"foundation_current" + name});
    if (contact.electric.circuit->resistor)
      list.add(heat, {"foundation_resistor_power" + name});
  }
  if (laws.is_warmed_by_friction())
    list.add(heat, {"friction_heat_body", "friction_heat_foundation"});
  for (const casefile::ElectrodeCase &electrode : asked.electrodes) {
    const std::string name = "electrode_" + electrode.name;
    list.add("V", {name + "_voltage"});
    list.add(charge, {name + "_charge"});
    list.add(whole("A", asked), {name + "_current"});
    if (electrode.resistor)
      list.add(heat, {name + "_resistor_power"});
  }
}

// What only some contacts have in history.csv, as solve/balance.h and run/recorder.h write it.
void add_contact(const casefile::Case &asked, List &list) {
  const contact::Contacts laws(asked.contacts, asked.time.end / asked.time.steps);
  if (laws.has_moving_foundation() || laws.has_normal_unknowns()) {
    list.add(whole("W", asked), {"foundation_power"});
    for (int c = first_moment(asked); c < 3; ++c)
      list.add(whole("N m", asked), {std::string("contact_moment_") + axes[c]});
  }
  if (laws.can_open()) {
    list.add(whole("J", asked), {"contact_energy"});
    list.add(whole("W", asked), {"contact_dissipation"});
  }
  if (laws.friction_depends_on_pressure() || laws.crosses_by_state(contact::Crossing::heat) ||
      laws.crosses_by_state(contact::Crossing::charge))
    list.add("", {"contact_stage"});
}

void add_contact_extremes(const casefile::Case &asked, List &list) {
  const contact::Contacts laws(asked.contacts, asked.time.end / asked.time.steps);
  if (!laws.has_normal_unknowns())
    return;
  std::vector<std::string> names{""};
  for (std::size_t i = 0; asked.contacts.size() > 1 && i < asked.contacts.size(); ++i)
    names.push_back("_" + asked.contacts[i].called());
  for (const std::string &name : names) {
    list.add("N/m^2", {"max_pressure" + name});
    list.add("m", {"max_opening" + name});
  }
}

// Of several contacts what each has, as run/contact_sums.cc writes it.
void add_each_contact(const casefile::Case &asked, List &list) {
  const contact::Contacts laws(asked.contacts, asked.time.end / asked.time.steps);
  for (std::size_t i = 0; asked.contacts.size() > 1 && i < asked.contacts.size(); ++i) {
    const std::string name = "_" + asked.contacts[i].called();
    list.add("", {"stick" + name, "slip" + name, "open" + name});
    for (int c = 0; c < asked.dimension; ++c)
      list.add(whole("N", asked), {std::string("contact_force_") + axes[c] + name});
    if (laws.has_moving_foundation() || laws.has_normal_unknowns())
      for (int c = first_moment(asked); c < 3; ++c)
        list.add(whole("N m", asked), {std::string("contact_moment_") + axes[c] + name});
    if (laws[i].lets_pass(contact::Crossing::heat))
      list.add(whole("W", asked), {"contact_heat" + name});
  }
}

// A material of a file of one's own may be damped without the case's saying so.
bool is_damped(const casefile::Case &asked) {
  const auto damps = [](const casefile::MaterialCase &material) {
    return std::any_of(material.constants.begin(), material.constants.end(), [](const auto &entry) {
      return entry.first.ends_with("_damping") && entry.second > 0;
    });
  };
  return damps(asked.material) ||
         std::any_of(asked.regions.begin(), asked.regions.end(),
                     [&](const casefile::RegionCase &region) { return damps(region.material); });
}

// What resists rates of u.
void add_motion(const casefile::Case &asked, List &list) {
  if (asked.time.is_dynamic()) {
    list.add(whole("J", asked), {"kinetic_energy"});
    list.add(whole("W", asked), {"kinetic_energy_rate"});
  }
  if (is_damped(asked))
    list.add(whole("W", asked), {"viscous_dissipation"});
  for (int c = 0; c < asked.dimension; ++c) {
    if (asked.time.is_dynamic())
      list.add(whole("N", asked), {std::string("inertia_") + axes[c]});
    if (is_damped(asked))
      list.add(whole("N", asked), {std::string("damping_force_") + axes[c]});
  }
}

void add_extremes(const casefile::Case &asked, List &list) {
  std::vector<Output> there = fields();
  std::erase_if(there, [&](const Output &field) { return !asked.model.has(field.name); });
  for (const Output &field : there)
    list.add(field.unit, {"min_" + field.name, "max_" + field.name});
  for (const Output &field : there)
    for (int c = 0; c < asked.dimension; ++c)
      for (const char *which : {"min_", "max_"})
        list.add("m", {"at_" + (which + field.name) + "_" + axes[c]});
}

// u, phi and theta, but for what is left out.
void add_probed_fields(const casefile::Case &asked, const std::string &prefix, List &list) {
  for (int c = 0; c < asked.dimension; ++c)
    list.add("m", {prefix + "u_" + axes[c]});
  for (const Output &field : fields())
    if (field.name != "displacement" && asked.model.has(field.name))
      list.add(field.unit, {prefix + field.name});
}

void add_boundary_probe(const casefile::Case &asked, const std::string &prefix, List &list) {
  for (int c = 0; c < asked.dimension; ++c)
    list.add(whole("N", asked), {prefix + "force_" + axes[c]});
  for (int c = asked.dimension == 2 ? 2 : 0; c < 3 && !asked.model.is_axisymmetric(); ++c)
    list.add(whole("N m", asked), {prefix + "moment_" + axes[c]});
  if (asked.model.electric)
    list.add(whole("C", asked), {prefix + "charge"});
  if (asked.model.thermal)
    list.add(whole("W", asked), {prefix + "heat"});
  list.add(whole("m^2", asked), {prefix + "area"});
}

void add_region_probe(const casefile::Case &asked, const std::string &prefix, List &list) {
  list.add(whole("m^3", asked), {prefix + "volume"});
  list.add_each(prefix, {"elastic_energy", "electric_energy", "thermal_energy", "coupling_energy"},
                whole("J", asked));
  for (const std::string kind : {"mean_", "min_", "max_"})
    add_probed_fields(asked, prefix + kind, list);
}

// As run/probes.cc writes them.
void add_probes(const casefile::Case &asked, List &list) {
  for (const casefile::ProbeCase &probe : asked.probes) {
    if (probe.on)
      add_boundary_probe(asked, probe.name + ".", list);
    if (probe.region)
      add_region_probe(asked, probe.name + ".", list);
    if (!probe.at)
      continue;
    for (int c = 0; c < asked.dimension; ++c)
      list.add("m", {probe.name + "." + axes[c]});
    add_probed_fields(asked, probe.name + ".", list);
  }
}

}  // namespace

std::vector<Output> outputs_of(const casefile::Case &asked) {
  List list;
  list.add("", {"step"});
  list.add("s", {"time"});
  list.add("", {"newton_iterations", "residual", "stick", "slip", "open"});
  list.add(whole("J", asked),
           {"elastic_energy", "electric_energy", "thermal_energy", "coupling_energy"});
  const std::string power = whole("W", asked);
  list.add(power, {"stored_energy_rate", "load_power", "electric_power", "thermal_power",
                   "friction_dissipation", "conduction_loss", "time_step_loss"});
  for (int c = 0; c < asked.dimension; ++c)
    for (const char *force : {"load_", "reaction_", "contact_force_"})
      list.add(whole("N", asked), {std::string(force) + axes[c]});
  add_motion(asked, list);
  add_flows(asked, list);
  add_contact(asked, list);
  list.add(power, {"stored_heat_rate", "heat_source"});
  list.add("", {"energy_imbalance", "force_imbalance", "charge_imbalance", "heat_imbalance"});
  add_extremes(asked, list);
  add_contact_extremes(asked, list);
  add_each_contact(asked, list);
  add_probes(asked, list);
  return list.all;
}

namespace {

std::vector<std::string> usual_names(const std::vector<casefile::Case> &cases) {
  std::vector<std::string> names{"max_displacement", "min_potential", "max_potential",
                                 "min_temperature", "max_temperature"};
  if (std::any_of(cases.begin(), cases.end(),
                  [](const auto &one) { return !one.contacts.empty(); }))
    names.insert(names.begin(), "slip");
  std::erase_if(names, [&](const std::string &name) {
    const std::size_t field = name.find('_');
    return field != std::string::npos &&
           std::none_of(cases.begin(), cases.end(), [&](const casefile::Case &one) {
             return one.model.has(name.substr(field + 1));
           });
  });
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

namespace {

constexpr std::string_view of_place = "at_";  // how the names of places begin

// Columns of probes, whose names may begin so, have a point.
bool is_place(const std::string &name) {
  return name.starts_with(of_place) && name.find('.') == std::string::npos;
}

std::string joined(const std::vector<std::string> &names, bool places) {
  std::string text;
  for (const std::string &name : names)
    if (is_place(name) == places)
      text += (text.empty() ? "" : ", ") + name;
  return text;
}

/// Reads what stands after `--output`.
class Chooser {
 public:
  Chooser(std::vector<Output> possible, double end) : possible_(std::move(possible)), end_(end) {
    for (const Output &output : possible_)
      names_.push_back(output.name);
  }

  Output choose(const std::string &name) const {
    if (const Output *output = find(name))  // first, as names of boundaries may have colons
      return *output;
    const auto at = name.rfind('@'), colon = name.find(':');
    const bool is_reduced = colon != std::string::npos && reduction_named(name.substr(0, colon));
    if (is_reduced && at != std::string::npos && !find(name.substr(colon + 1)))
      return in_window(name, colon, at);
    if (!is_reduced && at != std::string::npos)
      return at_time(name, at);
    if (colon != std::string::npos)
      return reduced_column(name, colon);
    fail_unknown(name, "", name, "");
  }

 private:
  [[noreturn]] void fail(const std::string &name, const std::string &reason) const {
    throw CaseError("--output " + casefile::shortened(name) + ": " + reason);
  }

  [[noreturn]] void fail_unknown(const std::string &name, const std::string &before,
                                 const std::string &column, const std::string &behind) const {
    const auto meant = casefile::nearest(column, names_);
    fail(name,
         "no column of history.csv or of a probe, as PROBE.COLUMN, and no place of an extreme is "
         "called so" +
             (meant ? "; did you mean \"" + before + *meant + behind + "\"?" : "") +
             "; allowed: " + joined(names_, false) +
             ", each also as min:NAME, max:NAME, mean:NAME, rms:NAME, last:NAME or NAME@TIME, "
             "the first four also over a part of the time, mean:NAME@FROM..TO" +
             ", and " + joined(names_, true) + "; the folder of a study is said by -o or --folder");
  }

  // WORD:NAME@FROM..TO
  Output in_window(const std::string &name, std::size_t colon, std::size_t at) const {
    const std::string word = name.substr(0, colon + 1), time = name.substr(at),
                      column = name.substr(colon + 1, at - colon - 1);
    Reduction reduction = *reduction_named(name.substr(0, colon));
    const auto dots = time.find("..");
    if (!find(column))
      fail_unknown(name, word, column, dots == std::string::npos ? "" : time);
    if (dots == std::string::npos)
      fail(name, fmt::format("{0} and {1} each make one number of a column, and here are both; "
                             "write {0}{2} or {2}{1}, or {0}{2}@FROM..TO of a part of the time",
                             word, time, column));
    if (reduction.kind == Reduction::Kind::last)
      fail(name, fmt::format("the last value of a part of the time is {}@{}; write that", column,
                             time.substr(dots + 2)));
    const auto from = seconds(time.substr(1, dots - 1)), to = seconds(time.substr(dots + 2));
    if (!from || !to || !(*from >= 0 && *from < *to && *to <= end_))
      fail(name,
           fmt::format("behind @ must be two numbers of seconds, FROM..TO, the first at least "
                       "0, the second above it and at most {}, the end of the runs",
                       end_));
    reduction.window = Reduction::Window{*from, *to};
    return made_of(name, word, column, time, reduction);
  }

  static std::optional<double> seconds(const std::string &text) {
    double time = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), time);
    if (error != std::errc() || end != text.data() + text.size())
      return std::nullopt;
    return time;
  }

  const Output *find(const std::string &name) const {
    const auto found = std::find(names_.begin(), names_.end(), name);
    return found == names_.end() ? nullptr : &possible_[found - names_.begin()];
  }

  Output made_of(const std::string &name, const std::string &before, const std::string &column,
                 const std::string &behind, const Reduction &reduction) const {
    const Output *output = find(column);
    if (!output)
      fail_unknown(name, before, column, behind);
    if (is_place(column))
      fail(name, column + " is a place, which a run has at its end only; write " + column);
    return {name, output->unit, column, reduction};
  }

  Output reduced_column(const std::string &name, std::size_t colon) const {
    const std::string word = name.substr(0, colon);
    const auto reduction = reduction_named(word);
    if (!reduction)
      fail(name, "\"" + word + "\" is nothing that can be made of a column" +
                     casefile::did_you_mean(word, reduction_words()) +
                     "; allowed: last:NAME, min:NAME, max:NAME, mean:NAME, rms:NAME, NAME@TIME");
    return made_of(name, name.substr(0, colon + 1), name.substr(colon + 1), "", *reduction);
  }

  Output at_time(const std::string &name, std::size_t at) const {
    const std::string text = name.substr(at + 1);
    if (text.find("..") != std::string::npos)
      fail(name, fmt::format("a part of the time has many values; write mean:{0}, or rms:, min: or "
                             "max:",
                             name));
    const std::optional<double> time = seconds(text);
    if (!time || !(*time > 0 && *time <= end_))
      fail(name, fmt::format("the time behind @ must be a number of seconds, above 0 and at most "
                             "{}, the end of the runs; write NAME@TIME",
                             end_));
    return made_of(name, "", name.substr(0, at), name.substr(at),
                   {.kind = Reduction::Kind::at, .time = *time});
  }

  std::vector<Output> possible_;
  std::vector<std::string> names_;
  double end_;  // of the longest run [s]
};

bool is_same(const Output &one, const Output &other) {
  const auto column = [](const Output &o) { return o.column.empty() ? o.name : o.column; };
  return column(one) == column(other) && one.reduction == other.reduction;
}

}  // namespace

std::vector<Output> chosen_outputs(const std::vector<std::string> &names,
                                   const std::vector<casefile::Case> &cases) {
  double end = 0;
  for (const casefile::Case &one : cases)
    end = std::max(end, one.time.end);
  const Chooser chooser(possible_outputs(cases), end);
  std::vector<Output> chosen;
  for (const std::string &name : names.empty() ? usual_names(cases) : names) {
    Output output = chooser.choose(name);
    if (std::any_of(chosen.begin(), chosen.end(),
                    [&](const Output &before) { return is_same(before, output); }))
      throw CaseError("--output " + name + ": is asked for twice");
    chosen.push_back(std::move(output));
  }
  return chosen;
}

namespace {

// by name, the coordinates of the extremes
std::map<std::string, double> places_in(const std::filesystem::path &file) {
  std::map<std::string, double> places;
  try {
    const auto summary = nlohmann::json::parse(report::read_text_file(file));
    for (const auto &extreme : summary.at("extremes"))
      for (const char *which : {"minimum", "maximum"}) {
        const auto &point = extreme.at(std::string("at_") + which);
        for (std::size_t c = 0; c < std::min(point.size(), std::size(axes)); ++c)
          places[std::string(of_place) + std::string(which).substr(0, 3) + "_" +
                 extreme.at("field").get<std::string>() + "_" + axes[c]] = point[c].get<double>();
      }
  } catch (const nlohmann::json::exception &) {
    throw CaseError(file.string() + ": is no summary of a run");
  }
  return places;
}

/// A column and the time of each of its rows.
struct Series {
  const std::vector<double> *times = nullptr, *values = nullptr;
};

/// The tables of a run's folder, of its probes those that somebody asks for.
class Tables {
 public:
  explicit Tables(std::filesystem::path folder)
      : folder_(std::move(folder)), history_(report::read_table(folder_ / "history.csv")) {
    if (!history_.find("time"))
      throw CaseError((folder_ / "history.csv").string() + ": is no history of a run");
  }

  /// Nothing where the run has no such column.
  Series find(const std::string &name) {
    if (const std::vector<double> *column = history_.find(name))
      return {history_.find("time"), column};
    const auto dot = name.rfind('.');
    if (dot == std::string::npos)
      return {};
    const report::Table *probe = table_of(name.substr(0, dot));
    return probe ? Series{probe->find("time"), probe->find(name.substr(dot + 1))} : Series{};
  }

 private:
  const report::Table *table_of(const std::string &probe) {
    const std::filesystem::path file = folder_ / output::probe_file(probe);
    if (!probes_.contains(probe) && std::filesystem::exists(file))
      probes_[probe] = report::read_table(file);
    const auto found = probes_.find(probe);
    return found == probes_.end() ? nullptr : &found->second;
  }

  std::filesystem::path folder_;
  report::Table history_;
  std::map<std::string, report::Table> probes_;
};

}  // namespace

std::vector<double> read_outputs(const std::filesystem::path &folder,
                                 const std::vector<Output> &outputs) {
  Tables tables(folder);
  const std::map<std::string, double> places = places_in(folder / "summary.json");
  std::vector<double> values;
  for (const Output &output : outputs) {
    const Series series = tables.find(output.column.empty() ? output.name : output.column);
    const auto place = places.find(output.name);
    values.push_back(series.times && series.values
                         ? reduced(output.reduction, *series.times, *series.values)
                     : place != places.end() ? place->second
                                             : std::numeric_limits<double>::quiet_NaN());
  }
  return values;
}

}  // namespace tourmaline::sweep
