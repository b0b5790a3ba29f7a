#include "solve/balance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "larger.h"
#include "solve/electrodes.h"
#include "solve/sized_sum.h"

namespace tourmaline::solve {

using body::field_of;
using body::Fields;
using body::LoadKind;

namespace {

// What a balance lacks beyond this may be round-off, which is told apart; what then lacks more than
// the next is looked at cell by cell, and more than this at once where the contact may take the
// body through states of little energy.
constexpr double unquestioned = 1e-10, unquestioned_without_contact = 1e-6;

// How many times an exchange of charge counts there.
template <int dim>
double charge_factor(const Model<dim> &model, const std::string &boundary) {
  for (const body::SurfaceExchange &exchange : model.linear_exchanges)
    if (exchange.field == body::SurfaceExchange::potential &&
        std::find(exchange.on.begin(), exchange.on.end(), boundary) != exchange.on.end())
      return exchange.factor;
  return 1;
}

// By unknown, what conditions of the case hold.
template <int dim>
std::vector<bool> given(const Model<dim> &model) {
  std::vector<bool> mask(model.n_unknowns(), false);
  for (const body::Prescribed &p : model.prescribed)
    mask[p.unknown] = p.is_given();
  return mask;
}

const char *const axes[] = {"x", "y", "z"};

}  // namespace

template <int dim>
Balance<dim>::Balance(const Model<dim> &model, std::span<const double> initial)
    : model_(model),
      is_prescribed_(given(model)),
      before_(initial_balance(model, initial)),
      of_step_(model.step),
      smallest_heat_(smallest_heat()),
      coupled_(coupled_fields(model)),
      boundaries_(model) {
  if (!model.electrodes.empty())
    electrode_charges_ = model.asked.time.is_dynamic() ? settled_charges(model, initial)
                                                       : initial_charges(model, initial);
  if (!model.laws.can_open())
    return;
  can_open_.resize(model.body.n_nodes());
  for (const contact::InterfaceNode<dim> &at : model.interface)
    can_open_[at.node] = model.laws.of(at).can_open();
}

// Where nothing warms a body, its heats are round-off and do not balance. They are measured by what
// warms it by 1e-12 theta_ref in one step, less than what any strain does; where heat flows
// steadily, by what flows into a node that is so much warmer than the others.
template <int dim>
double Balance<dim>::smallest_heat() const {
  if (model_.asked.time.is_static()) {
    const double step = std::ldexp(1., 100);  // which leaves only conduction
    const std::vector<double> diagonal = model_.op.diagonal(step);
    double most = 0;
    for (std::size_t i = Fields<dim>::temperature; i < diagonal.size(); i += Fields<dim>::count)
      most = larger(most, std::abs(diagonal[i]));
    most = model_.sharing().largest(most);
    return 1e-12 * most * std::pow(model_.op.reference_temperature(), 2) / step;
  }
  std::vector<double> warm(model_.n_unknowns(), 0.), product(model_.n_unknowns());
  for (std::size_t i = Fields<dim>::temperature; i < warm.size(); i += Fields<dim>::count)
    warm[i] = 1e-12 * model_.op.reference_temperature();
  model_.op.multiply(0, warm, product);
  double heat = 0;
  for (std::size_t i = Fields<dim>::temperature; i < warm.size(); i += Fields<dim>::count)
    heat += model_.counts(i) ? product[i] : 0;
  return std::abs(model_.sharing().sum(heat)) * model_.op.reference_temperature() / model_.step;
}

template <int dim>
typename Balance<dim>::Columns Balance<dim>::step(double time, std::span<const double> loads,
                                                  const StepOutcome &outcome,
                                                  std::span<const double> state, bool is_refined) {
  if (model_.step != of_step_) {
    of_step_ = model_.step;
    smallest_heat_ = smallest_heat();
    boundaries_.weigh();
  }
  const auto step_from = [&](BalancedState<dim> before, bool cell_by_cell) {
    return balance_step(model_, is_prescribed_, std::move(before),
                        model_.asked.time.is_dynamic() ? &forces_before_ : nullptr, time, loads,
                        outcome, state, cell_by_cell);
  };
  Step step = step_from(std::move(before_), is_refined);
  Columns columns = columns_of(step);
  const auto lacks_more_than = [&](double limit) {
    return std::any_of(judged_.begin(), judged_.end(), [limit](const auto &imbalance) {
      return !(std::abs(imbalance.second) <= limit);
    });
  };
  if (lacks_more_than(unquestioned)) {
    step.round_off = round_off_of(model_, coupled_, step);
    columns = columns_of(step);
  }
  const bool lacks =
      lacks_more_than(has_foundation_columns() ? unquestioned : unquestioned_without_contact);
  before_ = std::move(step.now);  // as a run that goes on from here has it
  if (lacks && !before_.by_cells) {
    step = step_from(std::move(step.before), true);
    step.round_off = round_off_of(model_, coupled_, step);
    columns = columns_of(step);
  }
  if (!model_.electrodes.empty())
    electrode_charges_ = charges_on_electrodes(step, before_.charges);
  if (step.is_dynamic())
    forces_before_ = {{loads.begin(), loads.end()},
                      std::move(step.contact),
                      std::move(step.friction),
                      std::move(step.rates.forces)};
  return columns;
}

template <int dim>
typename Balance<dim>::Columns Balance<dim>::columns_of(const Step &step) {
  Columns columns;
  judged_.clear();
  passages_.clear();
  add_energy(step, columns);
  add_forces(step, columns);
  add_charges(step, columns);
  add_electrodes(step, columns);
  add_heat(step, columns);
  return columns;
}

template <int dim>
void Balance<dim>::put_imbalance(const std::string &name, double value, double size,
                                 double round_off, Columns &columns) {
  const double lacks = std::copysign(std::max(0., std::abs(value) - round_off), value);
  columns.emplace_back(name, relative_to(std::isnan(value) ? value : lacks, size));
  judged_.emplace_back(columns.back());
}

// Global equilibrium: loads, reactions and contact forces add up to zero in every direction in
// which the body can be moved as a whole. Radial forces of a revolved body stand against its hoop
// stress.
template <int dim>
void Balance<dim>::add_forces(const Step &step, Columns &columns) {
  std::array<SizedSum, dim> load, reaction, contact;
  for (std::size_t i = 0; i < step.now.unknowns.size(); ++i) {
    const std::size_t c = i % Fields<dim>::count;
    if (c >= dim || !model_.counts(i))
      continue;
    load[c].add(step.loads[i]);
    contact[c].add(step.contact[i]);
    if (is_prescribed_[i])
      reaction[c].add(step.reaction(i));
  }
  for (std::array<SizedSum, dim> *forces : {&load, &reaction, &contact})
    for (SizedSum &sum : *forces)
      sum = sum.of_all(model_.sharing());
  find_forces(step);
  double worst = 0, size = 0;
  for (int c = 0; c < dim; ++c) {
    columns.emplace_back(std::string("load_") + axes[c], load[c].value);
    columns.emplace_back(std::string("reaction_") + axes[c], reaction[c].value);
    columns.emplace_back(std::string("contact_force_") + axes[c], contact[c].value);
    const double inertia = step.rates.inertia[static_cast<std::size_t>(c)],
                 damping = step.rates.damping[static_cast<std::size_t>(c)];
    if (step.is_dynamic())
      columns.emplace_back(std::string("inertia_") + axes[c], inertia);
    if (has_damping_columns())
      columns.emplace_back(std::string("damping_force_") + axes[c], damping);
    double lacks = load[c].value + reaction[c].value + contact[c].value;
    size += load[c].size + reaction[c].size + contact[c].size;
    if (!step.rates.forces.empty()) {
      lacks += inertia + damping;
      size += std::abs(inertia) + std::abs(damping);
    }
    if (c > 0 || !model_.asked.model.is_axisymmetric())
      worst = larger(worst, std::abs(lacks));
  }
  if (has_foundation_columns() && !model_.asked.model.is_axisymmetric())
    add_moment(step, columns);
  put_imbalance("force_imbalance", worst, size, step.round_off.force, columns);
}

template <int dim>
void Balance<dim>::find_forces(const Step &step) {
  for (const body::Prescribed &p : model_.prescribed)
    if (const int c = static_cast<int>(p.unknown % Fields<dim>::count); c < dim)
      passages_.push_back({static_cast<body::Node>(p.unknown / Fields<dim>::count), c,
                           step.reaction(p.unknown), p.boundary});
  for (std::size_t i = 0; i < model_.interface.size(); ++i)
    for (int c = 0; c < dim; ++c) {
      const body::Node node = model_.interface[i].node;
      passages_.push_back(
          {node, c, step.contact[body::unknown<dim>(node, c)], boundaries_.of_force(i)});
    }
}

// Of the contact forces about the origin.
template <int dim>
void Balance<dim>::add_moment(const Step &step, Columns &columns) const {
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  for (const contact::InterfaceNode<dim> &at : model_.interface) {
    Eigen::Vector3d force = Eigen::Vector3d::Zero();
    for (int c = 0; c < dim; ++c)
      force[c] = step.contact[body::unknown<dim>(at.node, c)];
    moment += Eigen::Vector3d(at.point.data()).cross(force);
  }
  for (int c = dim == 2 ? 2 : 0; c < 3; ++c)
    columns.emplace_back(std::string("contact_moment_") + axes[c], moment[c]);
}

// What holds prescribed potentials, and what crosses at the contact by its state, as D.nu.
template <int dim>
std::vector<Passage> Balance<dim>::charges_held(const Step &step) const {
  std::vector<Passage> held;
  for (const body::Prescribed &p : model_.prescribed)
    if (p.unknown % Fields<dim>::count == Fields<dim>::potential && p.is_given()) {
      const auto node = static_cast<body::Node>(p.unknown / Fields<dim>::count);
      held.push_back({node, Fields<dim>::potential,
                      step.now.charges[p.unknown] - step.known_charges()[p.unknown] -
                          step.charge_crossed[node],
                      p.boundary, p.electrode >= 0});
    }
  for (std::size_t i = 0; i < model_.interface.size(); ++i) {
    const body::Node node = model_.interface[i].node;
    const std::size_t unknown = body::unknown<dim>(node, Fields<dim>::potential);
    const std::string &boundary = boundaries_.of_charge(i);
    if (boundary.empty())
      continue;
    double charge = step.leaked.size() > 0 ? step.leaked[static_cast<Eigen::Index>(i)] : 0;
    charge += is_prescribed_[unknown] ? step.charge_crossed[node]
                                      : step.now.charges[unknown] - step.known_charges()[unknown];
    held.push_back({node, Fields<dim>::potential, charge, boundary});
  }
  return held;
}

// Gauss's law for the whole body: the integral of D.nu over all boundaries is the charge inside.
template <int dim>
void Balance<dim>::add_charges(const Step &step, Columns &columns) {
  std::map<std::string, double> through;
  double on_electrodes = 0;
  SizedSum imbalance;
  for (const Passage &at : charges_held(step)) {
    (at.is_on_electrode ? on_electrodes : through[std::string(at.boundary)]) += at.amount;
    imbalance.add(at.amount);
    passages_.push_back(at);
  }
  double inside = 0;
  for (const body::Load &load : model_.loads.each())
    if (load.kind().kind == LoadKind::surface_charge)
      through[load.kind().boundary] += load.resultant(step.time);
    else if (load.kind().kind == LoadKind::foundation_charge)
      through[load.kind().boundary] -=
          charge_factor(model_, load.kind().boundary) * load.resultant(step.time);
    else if (load.kind().kind == LoadKind::charge)
      inside += load.resultant(step.time);
  for (const std::string &name : boundaries_.of_charges()) {
    const double held = boundaries_.charge_held(name, step.now.unknowns);
    through[name] += held;
    imbalance.size += std::abs(held);
  }
  for (const std::string &name : boundaries_.of_charges())
    columns.emplace_back("charge_" + name, through[name]);
  double total = on_electrodes - inside;
  for (const auto &[name, charge] : through)
    total += charge;
  put_imbalance("charge_imbalance", total, imbalance.size + std::abs(inside), step.round_off.charge,
                columns);
}

// Without what crosses the contact at nodes that they share with it.
template <int dim>
Eigen::VectorXd Balance<dim>::charges_on_electrodes(const Step &step,
                                                    std::span<const double> charges) const {
  const std::span<const double> known = step.known_charges();
  std::vector<double> without(known.begin(), known.end());
  for (const std::vector<body::Node> &electrode : model_.electrodes)
    for (const body::Node node : electrode)
      without[body::unknown<dim>(node, Fields<dim>::potential)] += step.charge_crossed[node];
  return electrode_charges(model_, charges, without);
}

template <int dim>
void Balance<dim>::add_electrodes(const Step &step, Columns &columns) const {
  if (model_.electrodes.empty())
    return;
  const Eigen::VectorXd voltages = electrode_voltages(model_, step.now.unknowns);
  const Eigen::VectorXd charges = charges_on_electrodes(step, step.now.charges);
  for (std::size_t e = 0; e < model_.electrodes.size(); ++e) {
    const auto i = static_cast<Eigen::Index>(e);
    const std::string name = "electrode_" + model_.asked.electrodes[e].name;
    columns.emplace_back(name + "_voltage", voltages[i]);
    columns.emplace_back(name + "_charge", charges[i]);
    columns.emplace_back(name + "_current", (charges[i] - electrode_charges_[i]) / model_.step);
    if (const auto &resistor = model_.asked.electrodes[e].resistor) {
      const double across = voltages[i] - other_end(e, voltages, step.time);
      columns.emplace_back(name + "_resistor_power", across * across / *resistor);
    }
  }
}

template <int dim>
double Balance<dim>::other_end(std::size_t electrode, const Eigen::VectorXd &voltages,
                               double time) const {
  const std::vector<casefile::ElectrodeCase> &all = model_.asked.electrodes;
  const casefile::ElectrodeCase &from = all[electrode];
  if (!from.to)
    return from.voltage ? from.voltage->value({}, time) : 0;
  const auto to = std::find_if(all.begin(), all.end(),
                               [&](const auto &other) { return other.name == *from.to; });
  return voltages[to - all.begin()];
}

// What holds prescribed temperatures, and what crosses at the contact by its state, outwards.
template <int dim>
std::vector<Passage> Balance<dim>::heats_held(const Step &step) const {
  std::vector<Passage> held;
  for (const body::Prescribed &p : model_.prescribed)
    if (p.unknown % Fields<dim>::count == Fields<dim>::temperature && p.is_given()) {
      const auto node = static_cast<body::Node>(p.unknown / Fields<dim>::count);
      held.push_back({node, Fields<dim>::temperature, -step.heat_supplied[node], p.boundary});
    }
  for (std::size_t i = 0; i < model_.interface.size(); ++i)
    if (const std::string &boundary = boundaries_.of_heat(i); !boundary.empty()) {
      const body::Node node = model_.interface[i].node;
      held.push_back({node, Fields<dim>::temperature, -step.heat_crossed[node], boundary});
    }
  return held;
}

// Heat: what is stored comes from sources and has not left through the boundaries.
template <int dim>
void Balance<dim>::add_heat(const Step &step, Columns &columns) {
  std::map<std::string, double> out;
  SizedSum imbalance;
  for (const Passage &at : heats_held(step)) {
    passages_.push_back(at);
    if (!model_.sharing().counts(at.node))
      continue;
    out[std::string(at.boundary)] += at.amount;
    imbalance.size += std::abs(at.amount);
  }
  for (const std::string &name : boundaries_.of_heats())
    out[name] = model_.sharing().sum(out[name]);
  imbalance.size = model_.sharing().sum(imbalance.size);
  double source = 0;
  for (const body::Load &load : model_.loads.each())
    switch (const double resultant = load.resultant(step.time); load.kind().kind) {
      case LoadKind::heat:
        source += resultant;
        break;
      case LoadKind::heat_flux:
        out[load.kind().boundary] += resultant;
        break;
      case LoadKind::foundation_heat:
        out[load.kind().boundary] -= resultant;
        break;
      default:
        break;
    }
  for (const std::string &name : boundaries_.of_heats()) {
    out[name] += boundaries_.heat_exchanged(name, step.now.unknowns);
    columns.emplace_back("heat_" + name, out[name]);
    imbalance.add(out[name]);
  }
  double stored = 0;
  const double per_watt = -model_.step / model_.op.reference_temperature();
  for (std::size_t i = Fields<dim>::temperature;
       !model_.asked.time.is_static() && i < step.now.unknowns.size(); i += Fields<dim>::count)
    if (model_.counts(i))
      stored += (step.now.products.sum(i) - step.before.products.sum(i)) / per_watt;
  stored = model_.sharing().sum(stored);
  imbalance.add(stored);
  imbalance.add(-source);
  imbalance.size += smallest_heat_;
  columns.emplace_back("stored_heat_rate", stored);
  columns.emplace_back("heat_source", source);
  if (model_.laws.is_warmed_by_friction())
    add_friction_heat(step, columns);
  put_imbalance("heat_imbalance", imbalance.value, imbalance.size, step.round_off.heat, columns);
}

// Of the power of friction what warms the body, and the rest.
template <int dim>
void Balance<dim>::add_friction_heat(const Step &step, Columns &columns) const {
  double power = 0, warming = 0;
  for (std::size_t i = 0; i < model_.interface.size(); ++i) {
    const contact::InterfaceNode<dim> &at = model_.interface[i];
    if (!model_.laws.of(at).is_warmed_by_friction())
      continue;
    warming += step.friction_heat[static_cast<Eigen::Index>(i)];
    for (int c = 0; c < dim; ++c) {
      const std::size_t u = body::unknown<dim>(at.node, c);
      power -= step.friction[u] * (step.change(u) - step.carried_by(u)) / model_.step;
    }
  }
  columns.insert(columns.end(),
                 {{"friction_heat_body", warming}, {"friction_heat_foundation", power - warming}});
}

template <int dim>
void Balance<dim>::save(output::SavedNumbers &numbers) const {
  const body::Energies &stored = before_.stored;
  numbers.put_field("balance charges", before_.charges);
  numbers.put("balance electrodes", electrode_charges_);
  numbers.put("balance stored energy",
              {stored.elastic, stored.electric, stored.thermal, stored.coupling});
  if (!model_.asked.time.is_dynamic())
    return;
  numbers.put_field("balance loads", forces_before_.loads);
  numbers.put_field("balance contact", forces_before_.contact);
  numbers.put_field("balance friction", forces_before_.friction);
  numbers.put_field("balance rates", forces_before_.rates);
}

template <int dim>
void Balance<dim>::restore(const output::SavedNumbers &numbers) {
  numbers.fill("balance charges", before_.charges);
  numbers.fill("balance electrodes", electrode_charges_);
  const auto stored = numbers.get("balance stored energy", 4);
  before_.stored.elastic = stored[0];
  before_.stored.electric = stored[1];
  before_.stored.thermal = stored[2];
  before_.stored.coupling = stored[3];
  if (!model_.asked.time.is_dynamic())
    return;
  for (std::vector<double> *forces : {&forces_before_.loads, &forces_before_.contact,
                                      &forces_before_.friction, &forces_before_.rates})
    forces->resize(before_.unknowns.size());
  numbers.fill("balance loads", forces_before_.loads);
  numbers.fill("balance contact", forces_before_.contact);
  numbers.fill("balance friction", forces_before_.friction);
  numbers.fill("balance rates", forces_before_.rates);
}

template class Balance<2>;
template class Balance<3>;

}  // namespace tourmaline::solve
