#include "solve/balance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "larger.h"
#include "parallel/ranks.h"
#include "solve/electrodes.h"

namespace tourmaline::solve {

using body::Energies;
using body::field_of;
using body::Fields;
using body::LoadKind;

namespace {

// A sum with the sum of the sizes of its terms, by which an imbalance is measured.
struct Sum {
  double value = 0, size = 0;
  void add(double term) {
    value += term;
    size += std::abs(term);
  }
};

bool add_once(std::vector<std::string> &names, const std::string &name) {
  if (std::find(names.begin(), names.end(), name) != names.end())
    return false;
  names.push_back(name);
  return true;
}

// A balance that lacks less is not looked at any closer.
constexpr double unquestioned = 1e-6;

const char *const axes[] = {"x", "y", "z"};

}  // namespace

template <int dim>
struct Balance<dim>::Step {
  double time;
  std::span<const double> loads, state, before;
  body::FieldProducts products, products_before;
  std::vector<double> conducted;  // by node [W]
  std::vector<double> contact;    // by unknown [N]
  std::vector<double> friction;   // the part of it that opposes the slip
  std::vector<double> charges, charges_before;
  Energies stored_before;  // [J]
  // Of the sums: forces [N], charges [C], heats [W], energies [J].
  struct RoundOff {
    double force = 0, charge = 0, heat = 0;
    std::array<double, 3> energy{};  // by field
    std::array<bool, 3> is_all{};    // there is in a field
  } round_off;
  std::vector<double> heat_supplied;  // by node, at prescribed temperatures [W]

  double change(std::size_t i) const { return state[i] - before[i]; }
  double product_change(int field, std::size_t i) const {
    return products.of[field][i] - products_before.of[field][i];
  }
  Energies energy() const;
  Energies energy_of_change() const;
};

namespace {

template <int dim, class Value, class Product>
Energies energy_of(std::size_t n, const Value &value, const Product &product) {
  Energies energy;
  for (std::size_t i = 0; i < n; ++i) {
    const int field = field_of<dim>(i);
    if (field == 0) {
      energy.elastic += value(i) * product(0, i) / 2;
    } else if (field == 1) {
      energy.electric -= value(i) * product(1, i) / 2;
      energy.coupling -= value(i) * product(2, i);
    } else {
      energy.thermal -= value(i) * product(2, i) / 2;
    }
  }
  return energy;
}

// The coupling's part is that of phi, which theta is coupled to where there is any.
std::array<double, 3> by_field(const Energies &energy) {
  return {energy.elastic, energy.electric + energy.coupling, energy.thermal};
}

// Which fields (u, phi, theta) have anything to do with one another, over others as well.
template <int dim>
std::array<std::array<bool, 3>, 3> coupled_fields(const body::Operator<dim> &op, double step,
                                                  std::size_t n_unknowns) {
  std::array<std::array<bool, 3>, 3> coupled{};
  for (int g = 0; g < 3; ++g) {
    std::vector<double> of_one(n_unknowns);
    for (std::size_t i = 0; i < n_unknowns; ++i)
      of_one[i] = field_of<dim>(i) == g;
    const std::vector<double> rows = op.sizes(step, of_one);
    for (std::size_t i = 0; i < n_unknowns; ++i)
      if (rows[i] > 0)
        coupled[field_of<dim>(i)][g] = true;
  }
  for (int over = 0; over < 3; ++over)
    for (int f = 0; f < 3; ++f)
      for (int g = 0; g < 3; ++g)
        coupled[f][g] = coupled[f][g] || (coupled[f][over] && coupled[over][g]);
  return coupled;
}

}  // namespace

template <int dim>
Energies Balance<dim>::Step::energy() const {
  return energy_of<dim>(
      state.size(), [&](std::size_t i) { return state[i]; },
      [&](int field, std::size_t i) { return products.of[field][i]; });
}

template <int dim>
Energies Balance<dim>::Step::energy_of_change() const {
  return energy_of<dim>(
      state.size(), [&](std::size_t i) { return change(i); },
      [&](int field, std::size_t i) { return product_change(field, i); });
}

template <int dim>
Balance<dim>::Balance(const Model<dim> &model, std::span<const double> initial)
    : model_(model),
      state_(initial.begin(), initial.end()),
      is_prescribed_(body::mask_of(model.prescribed, initial.size())) {
  model.op.multiply_by_field(initial, products_);
  if (!model.electrodes.empty())
    electrode_charges_ = initial_charges(model, initial);
  stored_ = energy_of<dim>(
      initial.size(), [&](std::size_t i) { return initial[i]; },
      [&](int field, std::size_t i) { return products_.of[field][i]; });
  smallest_heat_ = smallest_heat();
  coupled_ = coupled_fields(model.op, model.step, initial.size());
  charges_.assign(initial.size(), 0.);
  for (std::size_t i = Fields<dim>::potential; i < initial.size(); i += Fields<dim>::count)
    charges_[i] = products_.sum(i);
  for (const body::Prescribed &p : model.prescribed) {
    const int component = static_cast<int>(p.unknown % Fields<dim>::count);
    if (component == Fields<dim>::temperature)
      add_once(heat_boundaries_, p.boundary);
    else if (component == Fields<dim>::potential && p.electrode < 0)
      add_once(charge_boundaries_, p.boundary);
  }
  for (const body::Load &load : model.loads.each())
    if (load.kind().kind == LoadKind::heat_flux)
      add_once(heat_boundaries_, load.kind().boundary);
    else if (load.kind().kind == LoadKind::surface_charge)
      add_once(charge_boundaries_, load.kind().boundary);
  if (!model.asked.contact || model.asked.contact->heat.law != "exchange")
    return;
  for (const std::string &name : model.asked.contact->on) {
    add_once(heat_boundaries_, name);
    exchange_[name] = exchange_weights(name);
  }
}

// Where nothing warms a body, its heats are round-off and do not balance. They are measured by what
// warms it by 1e-12 theta_ref in one step, less than what any strain does.
template <int dim>
double Balance<dim>::smallest_heat() const {
  std::vector<double> warm(model_.n_unknowns(), 0.), product(model_.n_unknowns());
  for (std::size_t i = Fields<dim>::temperature; i < warm.size(); i += Fields<dim>::count)
    warm[i] = 1e-12 * model_.op.reference_temperature();
  model_.op.multiply(0, warm, product);
  double heat = 0;
  for (std::size_t i = Fields<dim>::temperature; i < warm.size(); i += Fields<dim>::count)
    heat += product[i];
  return std::abs(heat) * model_.op.reference_temperature() / model_.step;
}

// The integral of k_c times each node's shape function over a boundary.
template <int dim>
std::vector<std::pair<body::Node, double>> Balance<dim>::exchange_weights(
    const std::string &boundary) const {
  std::vector<double> by_node(model_.body.n_nodes(), 0.);
  model_.body.for_each_facet({boundary}, [&](const body::Quadrature<dim> &facet) {
    for (std::size_t q = 0; q < facet.jxw.size(); ++q)
      for (std::size_t a = 0; a < facet.nodes.size(); ++a)
        by_node[facet.nodes[a]] +=
            model_.asked.contact->heat.coefficient.value(facet.points[q], 0) * facet.jxw[q] *
            facet.value(q, a);
  });
  parallel::sum(by_node);
  std::vector<std::pair<body::Node, double>> weights;
  for (const body::Node node : model_.body.nodes_on({boundary}))
    weights.emplace_back(node, by_node[node]);
  return weights;
}

// From the entries of the interface nodes.
template <int dim>
std::vector<double> Balance<dim>::by_unknown(const Eigen::VectorXd &forces) const {
  std::vector<double> all(model_.n_unknowns(), 0.);
  for (std::size_t i = 0; i < model_.interface.size(); ++i)
    for (int c = 0; c < dim; ++c)
      all[body::unknown<dim>(model_.interface[i].node, c)] =
          forces[dim * static_cast<Eigen::Index>(i) + c];
  return all;
}

template <int dim>
body::FieldProducts Balance<dim>::products(std::span<const double> state, bool cell_by_cell) const {
  body::FieldProducts products;
  if (cell_by_cell)
    model_.cells.multiply_by_field(state, products);
  else
    model_.op.multiply_by_field(state, products);
  return products;
}

template <int dim>
typename Balance<dim>::Step Balance<dim>::step_of(double time, std::span<const double> loads,
                                                  const StepOutcome &outcome,
                                                  std::span<const double> state,
                                                  bool cell_by_cell) {
  Step step{time, loads, state, state_, products(state, cell_by_cell), {}, {}, {}, {}, {},
            {},   {},    {},    {}};
  step.products_before = cell_by_cell ? products(state_, true) : std::move(products_);
  step.conducted = cell_by_cell ? model_.cells.conducted(state) : model_.op.conducted(state);
  step.contact = by_unknown(outcome.contact_forces);
  step.friction = by_unknown(outcome.friction_forces);
  step.charges.assign(state.size(), 0.);
  step.charges_before = std::move(charges_);
  for (std::size_t i = Fields<dim>::potential; i < state.size(); i += Fields<dim>::count) {
    step.charges[i] = is_prescribed_[i] ? step.products.sum(i) : loads[i];
    if (cell_by_cell && is_prescribed_[i])
      step.charges_before[i] = step.products_before.sum(i);
  }
  // The heat rows are scaled by -k / theta_ref; what they lack at prescribed temperatures was
  // supplied.
  const double per_watt = -model_.step / model_.op.reference_temperature();
  step.heat_supplied.assign(model_.body.n_nodes(), 0.);
  for (body::Node node = 0; node < model_.body.n_nodes(); ++node) {
    const std::size_t i = body::unknown<dim>(node, Fields<dim>::temperature);
    if (is_prescribed_[i])
      step.heat_supplied[node] =
          (step.products.sum(i) - step.products_before.sum(i) - loads[i]) / per_watt +
          step.conducted[node];
  }
  step.stored_before = stored_;
  if (cell_by_cell)
    step.stored_before = energy_of<dim>(
        state_.size(), [&](std::size_t i) { return state_[i]; },
        [&](int f, std::size_t i) { return step.products_before.of[f][i]; });
  return step;
}

// A solution is uncertain by the round-off of the largest scaled unknown of the fields that are
// coupled: that is what a field of which there is nothing consists of. Forces, charges and heats
// have |K| times that; energies cell by cell have its square, as K annihilates what changes none.
// That much a sum may lack.
template <int dim>
void Balance<dim>::measure_round_off(Step &step) const {
  constexpr double eps = std::numeric_limits<double>::epsilon(), several = 1e2;
  const std::vector<double> diagonal = model_.op.diagonal(model_.step);
  const auto scale = model_.op.scales(model_.step);
  std::array<double, 3> own{}, whole{};  // the largest scaled unknown, by field
  for (std::size_t i = 0; i < diagonal.size(); ++i)
    own[field_of<dim>(i)] =
        larger(own[field_of<dim>(i)], larger(std::abs(step.state[i]), std::abs(step.before[i])) /
                                          scale[i % Fields<dim>::count]);
  for (int f = 0; f < 3; ++f)
    for (int g = 0; g < 3; ++g)
      if (coupled_[f][g])
        whole[f] = larger(whole[f], own[g]);
  // All fields are solved for at once, so a little of one gets into another that has nothing to do
  // with it. Where there is nothing else, the balances are those of noise.
  constexpr double leaked = 1e-14;
  for (int f = 0; f < 3; ++f)
    step.round_off.is_all[f] = own[f] <= leaked * std::max({own[0], own[1], own[2]});
  std::vector<double> uncertain(diagonal.size());
  std::array<double, 3> most{};  // of the prescribed values, by field
  for (std::size_t i = 0; i < diagonal.size(); ++i)
    uncertain[i] = eps * whole[field_of<dim>(i)] * scale[i % Fields<dim>::count];
  // Some neighbours' share of the row in its own field. Couplings to other fields do not count: no
  // larger in a sound case, they would excuse any imbalance of constants out of all proportion.
  constexpr double neighbours = 10;
  std::vector<double> rows(diagonal.size());
  for (std::size_t i = 0; i < rows.size(); ++i)
    rows[i] = neighbours * std::abs(diagonal[i]) * uncertain[i];
  const double watt = model_.op.reference_temperature() / model_.step;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const int field = field_of<dim>(i);
    if (field == 0)
      step.round_off.force += rows[i];
    else if (field == 1)
      step.round_off.charge += rows[i];
    else
      step.round_off.heat += watt * rows[i];
    step.round_off.energy[field] += several * rows[i] * uncertain[i];
  }
  // What moves or holds prescribed values works against that round-off.
  for (const body::Prescribed &p : model_.prescribed) {
    const int field = field_of<dim>(p.unknown);
    most[field] =
        larger(most[field], std::abs(field == 0 ? step.change(p.unknown) : step.state[p.unknown]));
  }
  const std::array<double, 3> work{most[0] * step.round_off.force, most[1] * step.round_off.charge,
                                   most[2] * step.round_off.heat / watt};
  const std::array<double, 3> now = by_field(step.energy()), before = by_field(step.stored_before);
  for (int f = 0; f < 3; ++f)
    step.round_off.energy[f] += work[f] + several * eps * (std::abs(now[f]) + std::abs(before[f]));
  const std::array<double *, 3> sums{&step.round_off.force, &step.round_off.charge,
                                     &step.round_off.heat};
  for (int f = 0; f < 3; ++f)
    if (step.round_off.is_all[f])
      *sums[f] = std::numeric_limits<double>::infinity();
}

template <int dim>
typename Balance<dim>::Columns Balance<dim>::step(double time, std::span<const double> loads,
                                                  const StepOutcome &outcome,
                                                  std::span<const double> state, bool is_refined) {
  Step step = step_of(time, loads, outcome, state, is_refined);
  Columns columns = columns_of(step);
  const bool balances = std::all_of(judged_.begin(), judged_.end(), [](const auto &imbalance) {
    return std::abs(imbalance.second) <= unquestioned;
  });
  if (!balances) {
    charges_ = std::move(step.charges_before);
    step = step_of(time, loads, outcome, state, true);
    measure_round_off(step);
    columns = columns_of(step);
  }
  if (!model_.electrodes.empty())
    electrode_charges_ = electrode_charges(model_, step.charges, step.loads);
  stored_ = step.energy();
  state_.assign(state.begin(), state.end());
  charges_ = std::move(step.charges);
  products_ = std::move(step.products);
  return columns;
}

template <int dim>
typename Balance<dim>::Columns Balance<dim>::columns_of(const Step &step) {
  Columns columns;
  judged_.clear();
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

template <int dim>
void Balance<dim>::add_energy(const Step &step, Columns &columns) {
  const double per_watt = -model_.step / model_.op.reference_temperature();
  double load = 0, friction = 0, electric = 0, thermal = 0, conduction = 0;
  for (std::size_t i = 0; i < step.state.size(); ++i) {
    const int field = field_of<dim>(i);
    if (field == 0) {
      // What moves a prescribed displacement does work as a load does, and so does the foundation
      // along the normal: together it is zero where u_nu = 0. Friction is worked against.
      const double moving =
          is_prescribed_[i] ? step.products.sum(i) - step.contact[i] : step.loads[i];
      const double pressing = step.contact[i] - step.friction[i];
      load += (moving + pressing) * step.change(i);
      friction -= step.friction[i] * step.change(i);
    } else if (field == 1) {
      electric -= step.state[i] * (step.charges[i] - step.charges_before[i]);
    } else {
      const std::size_t node = i / Fields<dim>::count;
      thermal += step.state[i] * (-step.loads[i] - per_watt * step.heat_supplied[node]);
      conduction -= per_watt * step.state[i] * step.conducted[node];
    }
  }
  const Energies energy = step.energy(), shift = model_.op.energy_shift(step.state);
  const Energies loss = step.energy_of_change();
  const double lost = loss.sum(), before = step.stored_before.sum();
  Sum imbalance;
  for (const double term :
       {energy.sum(), -before, lost, -load, -electric, -thermal, friction, conduction})
    imbalance.add(term);
  const double k = model_.step;
  columns.insert(columns.end(), {{"elastic_energy", energy.elastic + shift.elastic},
                                 {"electric_energy", energy.electric + shift.electric},
                                 {"thermal_energy", energy.thermal + shift.thermal},
                                 {"coupling_energy", energy.coupling + shift.coupling},
                                 {"stored_energy_rate", (energy.sum() - before) / k},
                                 {"load_power", load / k},
                                 {"electric_power", electric / k},
                                 {"thermal_power", thermal / k},
                                 {"friction_dissipation", without_round_off(friction, step) / k},
                                 {"conduction_loss", conduction / k},
                                 {"time_step_loss", lost / k}});
  const std::array<double, 3> &round_off = step.round_off.energy;
  put_imbalance("energy_imbalance", imbalance.value, imbalance.size,
                round_off[0] + round_off[1] + round_off[2], columns);
  judged_.back().second =
      lack_of_energy(step, imbalance.size, by_field(loss),
                     {{{-load, friction}, {-electric}, {-thermal, conduction}}});
}

// Energy that does not change hides no lack, and neither does that of fields, such as a
// temperature, that others are not coupled to: each set of coupled fields has a balance of its own.
// `works` are what the field takes from outside, with a minus, and gives. A field of which there is
// nothing may hold what a solver let through from the others, 1e-14 of their scaled unknowns or
// less.
template <int dim>
double Balance<dim>::lack_of_energy(const Step &step, double whole,
                                    const std::array<double, 3> &lost,
                                    const std::array<std::vector<double>, 3> &works) const {
  constexpr double leaked = 1e-28;
  const std::array<double, 3> now = by_field(step.energy()), before = by_field(step.stored_before);
  double worst = 0;
  for (int f = 0; f < 3; ++f) {
    if (step.round_off.is_all[f])
      continue;
    double stored = 0, loss = 0, round_off = 0;
    Sum imbalance;
    for (int g = 0; g < 3; ++g) {
      if (g != f && !coupled_[f][g])
        continue;
      stored += now[g] - before[g];
      loss += lost[g];
      round_off += step.round_off.energy[g];
      for (const double work : works[g])
        imbalance.add(work);
    }
    imbalance.add(stored);
    imbalance.add(loss);
    const double lacks = std::abs(imbalance.value);
    worst = larger(worst, relative_to(std::isnan(lacks) ? lacks : std::max(0., lacks - round_off),
                                      std::max({imbalance.size, round_off, leaked * whole})));
  }
  return worst;
}

// A point that sticks moves by what the iteration leaves, in any direction.
template <int dim>
double Balance<dim>::without_round_off(double dissipated, const Step &step) const {
  double moved = 0, forces = 0;
  for (std::size_t i = 0; i < step.state.size(); ++i)
    if (field_of<dim>(i) == 0) {
      moved = larger(moved, std::abs(step.state[i]));
      forces += std::abs(step.friction[i]);
    }
  const double least = model_.asked.solver.tolerance * moved * forces;
  return dissipated < 0 && -dissipated <= least ? 0 : dissipated;
}

// Global equilibrium: loads, reactions and contact forces add up to zero in every direction.
template <int dim>
void Balance<dim>::add_forces(const Step &step, Columns &columns) {
  std::array<Sum, dim> load, reaction, contact;
  for (std::size_t i = 0; i < step.state.size(); ++i) {
    const std::size_t c = i % Fields<dim>::count;
    if (c >= dim)
      continue;
    load[c].add(step.loads[i]);
    contact[c].add(step.contact[i]);
    if (is_prescribed_[i])
      reaction[c].add(step.products.sum(i) - step.loads[i] - step.contact[i]);
  }
  double worst = 0, size = 0;
  for (int c = 0; c < dim; ++c) {
    columns.emplace_back(std::string("load_") + axes[c], load[c].value);
    columns.emplace_back(std::string("reaction_") + axes[c], reaction[c].value);
    columns.emplace_back(std::string("contact_force_") + axes[c], contact[c].value);
    worst = larger(worst, std::abs(load[c].value + reaction[c].value + contact[c].value));
    size += load[c].size + reaction[c].size + contact[c].size;
  }
  put_imbalance("force_imbalance", worst, size, step.round_off.force, columns);
}

// Gauss's law for the whole body: the integral of D.nu over all boundaries is the charge inside.
template <int dim>
void Balance<dim>::add_charges(const Step &step, Columns &columns) {
  std::map<std::string, double> through;
  double on_electrodes = 0;
  Sum imbalance;
  for (const body::Prescribed &p : model_.prescribed)
    if (p.unknown % Fields<dim>::count == Fields<dim>::potential) {
      const double charge = step.charges[p.unknown] - step.loads[p.unknown];
      (p.electrode < 0 ? through[p.boundary] : on_electrodes) += charge;
      imbalance.add(charge);
    }
  double inside = 0;
  for (const body::Load &load : model_.loads.each())
    if (load.kind().kind == LoadKind::surface_charge)
      through[load.kind().boundary] += load.resultant(step.time);
    else if (load.kind().kind == LoadKind::charge)
      inside += load.resultant(step.time);
  for (const std::string &name : charge_boundaries_)
    columns.emplace_back("charge_" + name, through[name]);
  double total = on_electrodes - inside;
  for (const auto &[name, charge] : through)
    total += charge;
  put_imbalance("charge_imbalance", total, imbalance.size + std::abs(inside), step.round_off.charge,
                columns);
}

template <int dim>
void Balance<dim>::add_electrodes(const Step &step, Columns &columns) const {
  if (model_.electrodes.empty())
    return;
  const Eigen::VectorXd voltages = electrode_voltages(model_, step.state);
  const Eigen::VectorXd charges = electrode_charges(model_, step.charges, step.loads);
  for (std::size_t e = 0; e < model_.electrodes.size(); ++e) {
    const auto i = static_cast<Eigen::Index>(e);
    const std::string name = "electrode_" + model_.asked.electrodes[e].name;
    columns.emplace_back(name + "_voltage", voltages[i]);
    columns.emplace_back(name + "_charge", charges[i]);
    columns.emplace_back(name + "_current", (charges[i] - electrode_charges_[i]) / model_.step);
  }
}

template <int dim>
double Balance<dim>::exchanged(const std::string &boundary, const Step &step) const {
  double flow = 0;
  if (const auto found = exchange_.find(boundary); found != exchange_.end())
    for (const auto &[node, weight] : found->second)
      flow += weight * step.state[body::unknown<dim>(node, Fields<dim>::temperature)];
  return flow;
}

// Heat: what is stored comes from sources and has not left through the boundaries.
template <int dim>
void Balance<dim>::add_heat(const Step &step, Columns &columns) {
  std::map<std::string, double> out;
  Sum imbalance;
  for (const body::Prescribed &p : model_.prescribed)
    if (p.unknown % Fields<dim>::count == Fields<dim>::temperature) {
      const double supplied = step.heat_supplied[p.unknown / Fields<dim>::count];
      out[p.boundary] -= supplied;
      imbalance.size += std::abs(supplied);
    }
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
  for (const std::string &name : heat_boundaries_) {
    out[name] += exchanged(name, step);
    columns.emplace_back("heat_" + name, out[name]);
    imbalance.add(out[name]);
  }
  double stored = 0;
  const double per_watt = -model_.step / model_.op.reference_temperature();
  for (std::size_t i = Fields<dim>::temperature; i < step.state.size(); i += Fields<dim>::count)
    stored += (step.products.sum(i) - step.products_before.sum(i)) / per_watt;
  imbalance.add(stored);
  imbalance.add(-source);
  imbalance.size += smallest_heat_;
  columns.emplace_back("stored_heat_rate", stored);
  columns.emplace_back("heat_source", source);
  put_imbalance("heat_imbalance", imbalance.value, imbalance.size, step.round_off.heat, columns);
}

template <int dim>
void Balance<dim>::save(output::SavedNumbers &numbers) const {
  numbers.put("balance charges", charges_);
  numbers.put("balance electrodes", electrode_charges_);
  numbers.put("balance stored energy",
              {stored_.elastic, stored_.electric, stored_.thermal, stored_.coupling});
}

template <int dim>
void Balance<dim>::restore(const output::SavedNumbers &numbers) {
  numbers.fill("balance charges", charges_);
  numbers.fill("balance electrodes", electrode_charges_);
  const auto stored = numbers.get("balance stored energy", 4);
  stored_.elastic = stored[0];
  stored_.electric = stored[1];
  stored_.thermal = stored[2];
  stored_.coupling = stored[3];
}

template class Balance<2>;
template class Balance<3>;

}  // namespace tourmaline::solve
