#include "sweep/outputs.h"

#include <algorithm>

#include "contact/contacts.h"
#include "tourmaline/case/case.h"

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

// Of several contacts what each has, as solve/balance.cc and run/contact_sums.cc write it.
void add_each_contact(const casefile::Case &asked, List &list) {
  const contact::Contacts laws(asked.contacts, asked.time.end / asked.time.steps);
  for (std::size_t i = 0; asked.contacts.size() > 1 && i < asked.contacts.size(); ++i) {
    const std::string name = "_" + asked.contacts[i].called();
    list.add(whole("W", asked), {"friction_dissipation" + name});
    if (laws.has_moving_foundation() || laws.has_normal_unknowns())
      list.add(whole("W", asked), {"foundation_power" + name});
    if (laws.can_open()) {
      list.add(whole("J", asked), {"contact_energy" + name});
      list.add(whole("W", asked), {"contact_dissipation" + name});
    }
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
        list.add("m", {of_place + (which + field.name) + "_" + axes[c]});
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

std::vector<Output> outputs_of(const std::vector<casefile::Case> &cases) {
  List list;
  for (const casefile::Case &one : cases)
    for (const Output &output : outputs_of(one))
      list.add(output.unit, {output.name});
  return list.all;
}

}  // namespace tourmaline::sweep
