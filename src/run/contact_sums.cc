#include "run/contact_sums.h"

#include <algorithm>
#include <array>
#include <limits>

namespace tourmaline::run {

namespace {

constexpr std::array axes{"x", "y", "z"};

using Quantities = std::vector<std::pair<std::string, double>>;

const double *find(const Quantities &quantities, const std::string &name) {
  const auto found = std::find_if(quantities.begin(), quantities.end(),
                                  [&](const auto &quantity) { return quantity.first == name; });
  return found == quantities.end() ? nullptr : &found->second;
}

/// Of the nodes of one contact.
struct Sums {
  std::array<std::size_t, 3> nodes{};  // by status
  Eigen::Vector3d force = Eigen::Vector3d::Zero(), moment = Eigen::Vector3d::Zero();
};

template <int dim>
Sums sums_of(const solve::Model<dim> &model, const solve::StepOutcome &outcome,
             std::size_t contact) {
  Sums sums;
  for (std::size_t i = 0; i < model.interface.size(); ++i) {
    const contact::InterfaceNode<dim> &at = model.interface[i];
    if (at.contact != contact)
      continue;
    ++sums.nodes[static_cast<std::size_t>(outcome.status[i])];
    Eigen::Vector3d force = Eigen::Vector3d::Zero();
    force.head<dim>() = outcome.contact_forces.segment<dim>(dim * static_cast<Eigen::Index>(i));
    sums.force += force;
    sums.moment += Eigen::Vector3d(at.point.data()).cross(force);
  }
  return sums;
}

template <int dim>
void add_sums(const Sums &sums, const std::string &name, Quantities &quantities) {
  const auto count = [&](const char *column, ContactStatus status) {
    quantities.emplace_back(column + name,
                            static_cast<double>(sums.nodes[static_cast<std::size_t>(status)]));
  };
  count("stick", ContactStatus::stick);
  count("slip", ContactStatus::slip);
  count("open", ContactStatus::open);
  for (int c = 0; c < dim; ++c)
    quantities.emplace_back(std::string("contact_force_") + axes[c] + name, sums.force[c]);
  for (int c = dim == 2 ? 2 : 0; c < 3; ++c)
    if (const std::string column = std::string("contact_moment_") + axes[c];
        find(quantities, column))
      quantities.emplace_back(column + name, sums.moment[c]);
}

// Through the boundaries of a contact.
void add_heat(const casefile::ContactCase &contact, const std::string &name,
              Quantities &quantities) {
  double heat = 0;
  for (const std::string &boundary : contact.on)
    if (const double *through = find(quantities, "heat_" + boundary))
      heat += *through;
  quantities.emplace_back("contact_heat" + name, heat);
}

}  // namespace

std::string name_of_several(const std::vector<casefile::ContactCase> &contacts,
                            std::size_t number) {
  return contacts.size() > 1 ? contacts[number].called() : "";
}

template <int dim>
void add_contact_sums(const solve::Model<dim> &model, const solve::StepOutcome &outcome,
                      double time, Quantities &quantities) {
  const std::vector<casefile::ContactCase> &contacts = model.asked.contacts;
  for (const solve::StepOutcome::Foundation &is : outcome.foundations) {
    const std::string name =
        contacts.size() > 1 ? "_" + contacts[is.contact].called() : std::string();
    quantities.insert(quantities.end(), {{"foundation_voltage" + name, is.voltage},
                                         {"foundation_charge" + name, is.charge},
                                         {"foundation_current" + name, is.current}});
    const casefile::FoundationCircuitCase &circuit = *contacts[is.contact].electric.circuit;
    const double across = is.voltage - circuit.voltage.value({}, time);
    if (circuit.resistor)
      quantities.emplace_back("foundation_resistor_power" + name,
                              across * across / *circuit.resistor);
  }
  for (std::size_t i = 0; contacts.size() > 1 && i < contacts.size(); ++i) {
    const std::string name = "_" + contacts[i].called();
    add_sums<dim>(sums_of(model, outcome, i), name, quantities);
    if (model.laws[i].lets_pass(contact::Crossing::heat))
      add_heat(contacts[i], name, quantities);
  }
}

template <int dim>
void add_contact_extremes(const solve::Model<dim> &model,
                          const std::vector<output::ContactRow> &rows, Quantities &quantities) {
  if (!model.laws.has_normal_unknowns() || rows.empty())
    return;
  const auto add = [&](const std::string &name, const auto &belongs) {
    double pressure = -std::numeric_limits<double>::infinity(), opening = pressure;
    for (const output::ContactRow &row : rows)
      if (belongs(row)) {
        pressure = std::max(pressure, -row.normal_traction);
        opening = std::max(opening, row.gap);
      }
    quantities.emplace_back("max_pressure" + name, pressure);
    quantities.emplace_back("max_opening" + name, opening);
  };
  add("", [](const auto &) { return true; });
  const std::vector<casefile::ContactCase> &contacts = model.asked.contacts;
  for (std::size_t i = 0; contacts.size() > 1 && i < contacts.size(); ++i)
    add("_" + contacts[i].called(), [&](const output::ContactRow &row) {
      return row.contact_number == static_cast<std::int32_t>(i);
    });
}

template <int dim>
std::vector<output::ContactRecord> contact_records(const solve::Model<dim> &model) {
  std::vector<output::ContactRecord> records;
  if (model.asked.contacts.size() < 2)
    return records;
  for (const casefile::ContactCase &contact : model.asked.contacts)
    records.push_back({contact.called()});
  for (const contact::InterfaceNode<dim> &at : model.interface)
    ++records[at.contact].nodes;
  return records;
}

template void add_contact_sums(const solve::Model<2> &, const solve::StepOutcome &, double,
                               Quantities &);
template void add_contact_sums(const solve::Model<3> &, const solve::StepOutcome &, double,
                               Quantities &);
template void add_contact_extremes(const solve::Model<2> &, const std::vector<output::ContactRow> &,
                                   Quantities &);
template void add_contact_extremes(const solve::Model<3> &, const std::vector<output::ContactRow> &,
                                   Quantities &);
template std::vector<output::ContactRecord> contact_records(const solve::Model<2> &);
template std::vector<output::ContactRecord> contact_records(const solve::Model<3> &);

}  // namespace tourmaline::run
