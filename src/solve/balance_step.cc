#include "solve/balance_step.h"

#include <cmath>
#include <limits>
#include <utility>

#include "larger.h"

namespace tourmaline::solve {

using body::Energies;
using body::field_of;
using body::Fields;

namespace {

template <int dim, class Value, class Product>
Energies energy_of(const body::NodeSharing &sharing, const Value &value, const Product &product) {
  Energies energy;
  for (std::size_t i = 0; i < sharing.n_nodes() * Fields<dim>::count; ++i) {
    if (!sharing.counts(static_cast<body::Node>(i / Fields<dim>::count)))
      continue;
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
  std::array<double, 4> sums{energy.elastic, energy.electric, energy.thermal, energy.coupling};
  sharing.sum(sums);
  return {sums[0], sums[1], sums[2], sums[3]};
}

template <int dim>
Energies stored_energy(const body::NodeSharing &sharing, const BalancedState<dim> &state) {
  return energy_of<dim>(
      sharing, [&](std::size_t i) { return state.unknowns[i]; },
      [&](int field, std::size_t i) { return state.products.of[field][i]; });
}

// From the entries of the interface nodes.
template <int dim>
std::vector<double> by_unknown(const Model<dim> &model, const Eigen::VectorXd &forces) {
  std::vector<double> all(model.n_unknowns(), 0.);
  for (std::size_t i = 0; i < model.interface.size(); ++i)
    for (int c = 0; c < dim; ++c)
      all[body::unknown<dim>(model.interface[i].node, c)] =
          forces[dim * static_cast<Eigen::Index>(i) + c];
  return all;
}

template <int dim>
void multiply(const Model<dim> &model, bool cell_by_cell, BalancedState<dim> &state) {
  state.products = model.products_by_field(state.unknowns, cell_by_cell);
  state.stored = stored_energy(model.sharing(), state);
  state.by_cells = cell_by_cell;
}

// By node, from the entries of the interface nodes; empty: nothing.
template <int dim>
std::vector<double> by_node(const Model<dim> &model, const Eigen::VectorXd &flows) {
  std::vector<double> all(model.body.n_nodes(), 0.);
  for (Eigen::Index i = 0; i < flows.size(); ++i)
    all[model.interface[static_cast<std::size_t>(i)].node] = flows[i];
  return all;
}

template <int dim>
void add_capacitors(const Model<dim> &model, bool cell_by_cell, BalanceStep<dim> &step) {
  const std::vector<double> held = cell_by_cell ? model.cells.held_by_capacitors(step.now.unknowns)
                                                : model.op.held_by_capacitors(step.now.unknowns);
  if (held.empty())
    return;
  step.with_capacitors.assign(step.loads.begin(), step.loads.end());
  for (body::Node node = 0; node < held.size(); ++node)
    step.with_capacitors[body::unknown<dim>(node, Fields<dim>::potential)] += held[node];
  for (Eigen::Index i = 0; i < step.leaked.size(); ++i)
    step.with_capacitors[body::unknown<dim>(model.interface[static_cast<std::size_t>(i)].node,
                                            Fields<dim>::potential)] += step.leaked[i];
}

// Known charges are loads and what crosses the contact; what holds a prescribed potential is what
// the products say.
template <int dim>
void find_charges(const std::vector<bool> &is_prescribed, bool cell_by_cell,
                  BalanceStep<dim> &step) {
  step.now.charges.assign(step.now.unknowns.size(), 0.);
  for (std::size_t i = Fields<dim>::potential; i < is_prescribed.size(); i += Fields<dim>::count) {
    step.now.charges[i] =
        is_prescribed[i] ? step.now.products.sum(i)
                         : step.known_charges()[i] + step.charge_crossed[i / Fields<dim>::count];
    if (cell_by_cell && is_prescribed[i])
      step.before.charges[i] = step.before.products.sum(i);
  }
}

// The heat rows are scaled by -k / theta_ref; what they lack at prescribed temperatures was
// supplied.
template <int dim>
std::vector<double> heat_supplied(const Model<dim> &model, const std::vector<bool> &is_prescribed,
                                  const BalanceStep<dim> &step) {
  const double per_watt = -model.step / model.op.reference_temperature();
  const bool stores = !model.asked.time.is_static();
  std::vector<double> supplied(model.body.n_nodes(), 0.);
  for (body::Node node = 0; node < model.body.n_nodes(); ++node) {
    const std::size_t i = body::unknown<dim>(node, Fields<dim>::temperature);
    if (!is_prescribed[i])
      continue;
    const double stored = stores ? step.now.products.sum(i) - step.before.products.sum(i) : 0;
    supplied[node] =
        (stored - step.loads[i]) / per_watt + step.conducted[node] - step.heat_crossed[node];
  }
  return supplied;
}

template <int dim>
std::vector<double> carried(const Model<dim> &model, double time,
                            const std::vector<double> &before) {
  std::vector<double> moved;
  model.carried(before, time, moved);
  for (std::size_t i = 0; i < moved.size(); ++i)
    moved[i] -= before[i];
  return moved;
}

// By field, the largest scaled unknown of all that it is coupled to.
template <int dim>
std::array<double, 3> coupled_sizes(const body::NodeSharing &sharing, const CoupledFields &coupled,
                                    const BalanceStep<dim> &step,
                                    const std::array<double, Fields<dim>::count> &scale) {
  const std::vector<double> &now = step.now.unknowns, &before = step.before.unknowns;
  std::array<double, 3> own{}, whole{};  // the largest scaled unknown, by field
  for (std::size_t i = 0; i < now.size(); ++i)
    own[field_of<dim>(i)] =
        larger(own[field_of<dim>(i)],
               larger(std::abs(now[i]), std::abs(before[i])) / scale[i % Fields<dim>::count]);
  sharing.largest(own);
  for (int f = 0; f < 3; ++f)
    for (int g = 0; g < 3; ++g)
      if (coupled[f][g])
        whole[f] = larger(whole[f], own[g]);
  return whole;
}

// All fields are solved for at once, by which a little of one gets into others that have nothing to
// do with it. Where there is nothing else, balances are those of noise, and may lack anything.
void excuse_leaks(const std::array<double, 3> &size, BalanceRoundOff &sums) {
  constexpr double leaked = 1e-14, anything = std::numeric_limits<double>::infinity();
  const double largest = larger(larger(size[0], size[1]), size[2]);
  double *const of_field[] = {&sums.force, &sums.charge, &sums.heat};
  for (int f = 0; f < 3; ++f)
    if (size[f] <= leaked * largest)
      *of_field[f] = sums.energy[f] = anything;
}

// By how much the contact is open at most [m]: the contact is solved from where it is closed, and
// forces have the round-off of those that would pull the body there.
template <int dim>
double widest_opening(const Model<dim> &model, const BalanceStep<dim> &step) {
  double widest = 0;
  for (const contact::InterfaceNode<dim> &at : model.interface) {
    if (!model.laws.of(at).can_open())
      continue;
    double opening = model.reach(at, step.time);
    for (int c = 0; c < dim; ++c)
      opening -= at.normal[c] * step.now.unknowns[body::unknown<dim>(at.node, c)];
    widest = std::max(widest, opening);
  }
  return widest;
}

// What moves or holds prescribed values, and what moves or crosses at the contact, works against
// the round-off of forces, charges and heats [J].
template <int dim>
std::array<double, 3> work_of_round_off(const Model<dim> &model, const BalanceStep<dim> &step,
                                        const BalanceRoundOff &sums) {
  std::array<double, 3> most{};  // of the prescribed values, by field
  for (const body::Prescribed &p : model.prescribed) {
    const int field = field_of<dim>(p.unknown);
    const double moved = field == 0 ? step.change(p.unknown) : step.now.unknowns[p.unknown];
    most[field] = larger(most[field], std::abs(moved));
  }
  const auto see = [&](int field, double value) {
    most[field] = larger(most[field], std::abs(value));
  };
  for (const contact::InterfaceNode<dim> &at : model.interface) {
    for (int c = 0; c < dim; ++c)
      see(0, step.change(body::unknown<dim>(at.node, c)));
    const contact::ContactLaws &laws = model.laws.of(at);
    if (laws.lets_pass(contact::Crossing::charge))
      see(1, step.now.unknowns[body::unknown<dim>(at.node, Fields<dim>::potential)]);
    if (laws.lets_pass(contact::Crossing::heat))
      see(2, step.now.unknowns[body::unknown<dim>(at.node, Fields<dim>::temperature)]);
  }
  model.sharing().largest(most);
  const double watt = model.op.reference_temperature() / model.step;
  return {most[0] * sums.force, most[1] * sums.charge, most[2] * sums.heat / watt};
}

}  // namespace

std::array<double, 3> by_field(const Energies &energy) {
  return {energy.elastic, energy.electric + energy.coupling, energy.thermal};
}

template <int dim>
Energies BalanceStep<dim>::energy_of_change(const body::NodeSharing &sharing) const {
  return energy_of<dim>(
      sharing, [&](std::size_t i) { return change(i); },
      [&](int field, std::size_t i) { return product_change(field, i); });
}

template <int dim>
Energies BalanceStep<dim>::change_of_energy(const body::NodeSharing &sharing) const {
  const auto moved = [&](std::size_t i) { return change(i); };
  const auto twice = [&](std::size_t i) { return now.unknowns[i] + before.unknowns[i]; };
  Energies energy = energy_of<dim>(sharing, moved, [&](int field, std::size_t i) {
    return now.products.of[field][i] + before.products.of[field][i];
  });
  // Not a square: half of it changes with phi, the other half with theta.
  const Energies other = energy_of<dim>(
      sharing, twice, [&](int field, std::size_t i) { return product_change(field, i); });
  energy.coupling = (energy.coupling + other.coupling) / 2;
  return energy;
}

template <int dim>
CoupledFields coupled_fields(const Model<dim> &model) {
  CoupledFields coupled{};
  for (int g = 0; g < 3; ++g) {
    std::vector<double> of_one(model.n_unknowns());
    for (std::size_t i = 0; i < of_one.size(); ++i)
      of_one[i] = field_of<dim>(i) == g;
    const std::vector<double> rows = model.op.sizes(model.step, of_one);
    std::array<double, 3> largest{};
    for (std::size_t i = 0; i < rows.size(); ++i)
      largest[field_of<dim>(i)] = std::max(largest[field_of<dim>(i)], rows[i]);
    model.sharing().largest(largest);
    for (int f = 0; f < 3; ++f)
      coupled[f][g] = largest[f] > 0;
  }
  for (int over = 0; over < 3; ++over)
    for (int f = 0; f < 3; ++f)
      for (int g = 0; g < 3; ++g)
        coupled[f][g] = coupled[f][g] || (coupled[f][over] && coupled[over][g]);
  return coupled;
}

template <int dim>
BalancedState<dim> initial_balance(const Model<dim> &model, std::span<const double> initial) {
  BalancedState<dim> state;
  state.unknowns.assign(initial.begin(), initial.end());
  multiply(model, false, state);
  state.charges.assign(initial.size(), 0.);
  for (std::size_t i = Fields<dim>::potential; i < initial.size(); i += Fields<dim>::count)
    state.charges[i] = state.products.sum(i);
  return state;
}

template <int dim>
BalanceStep<dim> balance_step(const Model<dim> &model, const std::vector<bool> &is_prescribed,
                              BalancedState<dim> before, const EndForces *earlier, double time,
                              std::span<const double> loads, const StepOutcome &outcome,
                              std::span<const double> now, bool cell_by_cell) {
  BalanceStep<dim> step;
  step.time = time;
  step.loads = loads;
  step.before = std::move(before);
  step.earlier = earlier;
  step.rates = outcome.rates;
  step.now.unknowns.assign(now.begin(), now.end());
  multiply(model, cell_by_cell, step.now);
  if (cell_by_cell && !step.before.by_cells)
    multiply(model, true, step.before);
  step.conducted = cell_by_cell ? model.cells.conducted(now) : model.op.conducted(now);
  step.contact = by_unknown(model, outcome.contact_forces);
  step.friction = by_unknown(model, outcome.friction_forces);
  step.carried = carried(model, time, step.before.unknowns);
  step.backward_error = outcome.backward_error;
  step.leaked = outcome.leaked_charge;
  add_capacitors(model, cell_by_cell, step);
  step.charge_crossed = by_node(model, outcome.charge_flow);
  find_charges(is_prescribed, cell_by_cell, step);
  step.friction_heat = outcome.friction_heat;
  step.heat_crossed = by_node(model, -outcome.heat_flow);
  step.heat_supplied = heat_supplied(model, is_prescribed, step);
  return step;
}

template <int dim>
EndForces initial_forces(const Model<dim> &model, const BalancedState<dim> &initial,
                         const RateRecord &rates) {
  const std::size_t n = initial.unknowns.size();
  EndForces forces{std::vector<double>(n, 0.), std::vector<double>(n, 0.),
                   std::vector<double>(n, 0.), rates.forces};
  model.add_loads(0, forces.loads);
  for (const contact::InterfaceNode<dim> &at : model.interface) {
    using Vector = typename Model<dim>::Vector;
    const std::size_t first = body::unknown<dim>(at.node, 0);
    Vector lacks;
    for (int c = 0; c < dim; ++c)
      lacks[c] =
          initial.products.sum(first + c) + rates.forces[first + c] - forces.loads[first + c];
    Vector::Map(&forces.contact[first]) = lacks;
    Vector::Map(&forces.friction[first]) = lacks - lacks.dot(at.normal) * at.normal;
  }
  return forces;
}

namespace {

// Adds what contact nodes let through by their state, closed and without pressure, to the diagonal
// of potentials and temperatures, which the operator has without it.
template <int dim>
void add_exchanges(const Model<dim> &model, double watt, std::vector<double> &diagonal) {
  const auto add = [&](contact::Crossing what, int component, double unit) {
    for (const contact::InterfaceNode<dim> &at : model.interface)
      if (!model.laws.of(at).linear(what))
        if (const auto exchange = model.laws.of(at).exchange(what, at.point, 0, 0))
          diagonal[body::unknown<dim>(at.node, component)] +=
              std::abs(at.weight * exchange->at(0, {}).by_value) / unit;
  };
  add(contact::Crossing::charge, Fields<dim>::potential, 1);
  add(contact::Crossing::heat, Fields<dim>::temperature, watt);
}

// Of the rows of a field.
template <int dim>
double norm(const Model<dim> &model, int field, std::span<const double> vector) {
  double squares = 0;
  for (std::size_t i = 0; i < vector.size(); ++i)
    squares += field_of<dim>(i) == field && model.counts(i) ? vector[i] * vector[i] : 0;
  return std::sqrt(model.sharing().sum(squares));
}

// Solutions by iteration leave residuals of `linear_tolerance` times what each field contributes to
// the rows of a field, and energies what these do along the unknowns: of both states that a step
// compares.
template <int dim>
void add_work_of_residuals(const Model<dim> &model, const BalanceStep<dim> &step,
                           BalanceRoundOff &sums) {
  const bool is_by_iteration = step.backward_error > 0;
  for (const BalancedState<dim> *state : {&step.before, &step.now})
    for (int f = 0; is_by_iteration && f < 3; ++f) {
      double contributed = 0;
      for (const std::vector<double> &product : state->products.of)
        contributed = larger(contributed, norm(model, f, product));
      sums.energy[f] +=
          model.asked.solver.linear_tolerance * contributed * norm(model, f, state->unknowns);
    }
}

}  // namespace

// Of the diagonal some neighbours' share of the row in its own field. Couplings to other fields do
// not count: no larger in a sound case, they would excuse any imbalance of constants out of all
// proportion.
template <int dim>
BalanceRoundOff round_off_of(const Model<dim> &model, const CoupledFields &coupled,
                             const BalanceStep<dim> &step) {
  constexpr double several = 1e2, neighbours = 10;
  const double eps = larger(std::numeric_limits<double>::epsilon(), step.backward_error);
  std::vector<double> diagonal = model.op.diagonal(model.step);
  const std::array<double, Fields<dim>::count> scale = model.op.scales(diagonal);
  std::array<double, 3> size = coupled_sizes(model.sharing(), coupled, step, scale);
  size[0] = std::max(size[0], widest_opening(model, step) / scale[0]);
  const double watt = model.op.reference_temperature() / model.step;
  add_exchanges(model, watt, diagonal);
  std::array<double, 3> rows{}, energy{};
  for (std::size_t i = 0; i < diagonal.size(); ++i) {
    if (!model.counts(i))
      continue;
    const int field = field_of<dim>(i);
    const double uncertain = eps * size[field] * scale[i % Fields<dim>::count],
                 row = neighbours * std::abs(diagonal[i]) * uncertain;
    rows[field] += row;
    energy[field] += several * row * uncertain;
  }
  model.sharing().sum(rows);
  model.sharing().sum(energy);
  BalanceRoundOff sums{rows[0], rows[1], watt * rows[2], energy};
  const std::array<double, 3> work = work_of_round_off(model, step, sums),
                              now = by_field(step.now.stored),
                              before = by_field(step.before.stored);
  for (int f = 0; f < 3; ++f)
    sums.energy[f] += work[f] + several * eps * (std::abs(now[f]) + std::abs(before[f]));
  sums.energy[0] += several * eps * step.rates.kinetic_energy;
  add_work_of_residuals(model, step, sums);
  excuse_leaks(size, sums);
  return sums;
}

template struct BalanceStep<2>;
template struct BalanceStep<3>;
template CoupledFields coupled_fields<2>(const Model<2> &);
template CoupledFields coupled_fields<3>(const Model<3> &);
template BalancedState<2> initial_balance<2>(const Model<2> &, std::span<const double>);
template BalancedState<3> initial_balance<3>(const Model<3> &, std::span<const double>);
template BalanceStep<2> balance_step<2>(const Model<2> &, const std::vector<bool> &,
                                        BalancedState<2>, const EndForces *, double,
                                        std::span<const double>, const StepOutcome &,
                                        std::span<const double>, bool);
template EndForces initial_forces<2>(const Model<2> &, const BalancedState<2> &,
                                     const RateRecord &);
template BalanceStep<3> balance_step<3>(const Model<3> &, const std::vector<bool> &,
                                        BalancedState<3>, const EndForces *, double,
                                        std::span<const double>, const StepOutcome &,
                                        std::span<const double>, bool);
template EndForces initial_forces<3>(const Model<3> &, const BalancedState<3> &,
                                     const RateRecord &);
template BalanceRoundOff round_off_of<2>(const Model<2> &, const CoupledFields &,
                                         const BalanceStep<2> &);
template BalanceRoundOff round_off_of<3>(const Model<3> &, const CoupledFields &,
                                         const BalanceStep<3> &);

}  // namespace tourmaline::solve
