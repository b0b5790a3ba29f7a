#include "solve/foundation_circuits.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "larger.h"
#include "solve/electrodes.h"
#include "solve/exchange_nodes.h"
#include "solve/exchange_weights.h"
#include "tourmaline/error.h"

namespace tourmaline::solve {

using body::Fields;
using body::unknown;
using contact::Crossing;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

template <int dim>
FoundationCircuits<dim>::FoundationCircuits(const Model<dim> &model)
    : model_(model), circuit_(as_electrodes(model.asked.contacts), model.step) {
  for (std::size_t c = 0; c < model.found_potentials.size(); ++c)
    if (model.found_potentials[c])
      foundations_.emplace_back().contact = c;
  charges_ = before_ = potentials_ = VectorXd::Zero(static_cast<Index>(foundations_.size()));
  search_ = ProbedNewton(potentials_.size());
  make();
  put_potentials();
}

template <int dim>
void FoundationCircuits<dim>::begin(std::span<const double> initial) {
  for (std::size_t f = 0; f < foundations_.size(); ++f)
    if (!model_.laws[foundations_[f].contact].remembers_charge())
      charges_[static_cast<Index>(f)] = charge_at_start(f, initial);
}

// Q - what has come in, beyond what the potentials hold in capacitors: what is there at once.
template <int dim>
VectorXd FoundationCircuits<dim>::brought_at_once() const {
  if (foundations_.empty())  // which BLAS refuses
    return {};
  const Circuit at_once(as_electrodes(model_.asked.contacts), 0);
  return at_once.right_side(std::nullopt, 0, charges_, before_, potentials_) -
         at_once.admittance() * potentials_;
}

template <int dim>
VectorXd FoundationCircuits<dim>::lacks_at_start(std::span<const double> state) const {
  VectorXd lacks = -brought_at_once();
  for (std::size_t f = 0; f < foundations_.size(); ++f)
    lacks[static_cast<Index>(f)] += charge_at_start(f, state);
  return lacks;
}

template <int dim>
void FoundationCircuits<dim>::put_at_start(const VectorXd &potentials) {
  potentials_ = potentials;
  put_potentials();
}

template <int dim>
void FoundationCircuits<dim>::begin_settled() {
  charges_ = brought_at_once();
  before_ = potentials_;
}

template <int dim>
std::vector<casefile::ElectrodeCase> FoundationCircuits<dim>::as_electrodes(
    const std::vector<casefile::ContactCase> &contacts) {
  std::vector<casefile::ElectrodeCase> electrodes;
  for (const casefile::ContactCase &contact : contacts)
    if (const auto &circuit = contact.electric.circuit) {
      casefile::ElectrodeCase &electrode = electrodes.emplace_back();
      electrode.charge = circuit->charge;
      electrode.resistor = circuit->resistor;
      electrode.capacitor = circuit->capacitor;
      if (circuit->is_loaded())
        electrode.voltage = circuit->voltage;
    }
  return electrodes;
}

template <int dim>
void FoundationCircuits<dim>::make() {
  of_step_ = model_.step;
  circuit_ = Circuit(as_electrodes(model_.asked.contacts), of_step_);
  capacities_ = circuit_.admittance().diagonal();
  for (std::size_t f = 0; f < foundations_.size(); ++f) {
    foundations_[f] = foundation(foundations_[f].contact);
    capacities_[static_cast<Index>(f)] += foundations_[f].capacitance;
  }
  search_.set_sizes(capacities_);
}

// The slope changes by what the circuits have of it; where what the contact has depends on the
// step as well, the search finds out.
template <int dim>
void FoundationCircuits<dim>::follow_step() {
  if (of_step_ != model_.step)
    make();
  if (search_.knows_slope() && slope_of_step_ != of_step_)
    search_.add_to_slope(
        circuit_.admittance() -
        Circuit(as_electrodes(model_.asked.contacts), slope_of_step_).admittance());
  slope_of_step_ = of_step_;
}

// A law that asks for the contact's state is summed at the nodes; the most that it lets pass, with
// the contact closed, stands for its coefficient.
template <int dim>
typename FoundationCircuits<dim>::Foundation FoundationCircuits<dim>::foundation(
    std::size_t contact) const {
  Foundation made;
  made.contact = contact;
  if (const auto linear = model_.laws[contact].linear(Crossing::charge)) {
    made.is_linear = true;
    made.accumulates = linear->accumulates;
    made.weights = exchange_weights(model_.body, linear->on, linear->coefficient, linear->factor);
  } else {
    for (const contact::InterfaceNode<dim> &at : model_.interface)
      if (at.contact == contact)
        made.weights.emplace_back(at.node,
                                  at.weight * model_.laws[contact]
                                                  .exchange(Crossing::charge, at.point, 0, 0)
                                                  ->at(0, {})
                                                  .by_value);
  }
  for (const auto &[node, weight] : made.weights)
    made.capacitance += weight;
  if (made.capacitance == 0)
    throw CaseError(fmt::format(
        "{} [contact]: electric.coefficient is 0 all over contact \"{}\", so that no charge comes "
        "to its foundation, whose circuit then finds no potential; give it a coefficient > 0, or "
        "leave electric out",
        model_.asked.source, model_.asked.contacts[contact].called()));
  return made;
}

// What has crossed a leak by then is what crosses it in one step, which the body has in it as well.
template <int dim>
double FoundationCircuits<dim>::charge_at_start(std::size_t f,
                                                std::span<const double> state) const {
  const Foundation &of = foundations_[f];
  double crossed = 0;
  if (of.is_linear) {
    for (const auto &[node, weight] : of.weights)
      crossed += weight * (state[unknown<dim>(node, Fields<dim>::potential)] -
                           potentials_[static_cast<Index>(f)]);
    return -crossed;
  }
  for (const contact::InterfaceNode<dim> &at : model_.interface)
    if (at.contact == of.contact)
      crossed += at.weight * charge_exchange_at_start(model_, at, state).flow;
  return -crossed;
}

// A linear leak adds to what has crossed before.
template <int dim>
double FoundationCircuits<dim>::crossed(std::size_t f, std::span<const double> state,
                                        const StepOutcome &outcome) const {
  const Foundation &of = foundations_[f];
  const auto row = static_cast<Index>(f);
  double sum = 0;
  if (!of.is_linear) {
    for (std::size_t i = 0; i < model_.interface.size(); ++i)
      if (model_.interface[i].contact == of.contact)
        sum += outcome.charge_flow[static_cast<Index>(i)];
    return sum;
  }
  for (const auto &[node, weight] : of.weights)
    sum += weight * (state[unknown<dim>(node, Fields<dim>::potential)] - potentials_[row]);
  return of.accumulates ? sum - charges_[row] : sum;
}

// What a sum of charges is made of, by which its round-off is measured; where the step comes from
// counts, too, as all may be zero where it leads.
template <int dim>
double FoundationCircuits<dim>::size(std::size_t f, std::span<const double> state) const {
  const Foundation &of = foundations_[f];
  const auto row = static_cast<Index>(f);
  double size = capacities_[row] * larger(std::abs(potentials_[row]), std::abs(before_[row]));
  for (const auto &[node, weight] : of.weights)
    size += weight * std::abs(state[unknown<dim>(node, Fields<dim>::potential)]);
  return size;
}

template <int dim>
typename FoundationCircuits<dim>::Lack FoundationCircuits<dim>::lack(
    double time, std::span<const double> state, const StepOutcome &outcome) const {
  const VectorXd supplied =
      circuit_.right_side(sources_before(model_, time), time, charges_, before_, potentials_);
  Lack lack;
  lack.charges.resize(potentials_.size());
  lack.sizes.resize(potentials_.size());
  for (std::size_t f = 0; f < foundations_.size(); ++f) {
    const auto row = static_cast<Index>(f);
    lack.charges[row] = -crossed(f, state, outcome);
    lack.sizes[row] = size(f, state) + std::abs(supplied[row]);
  }
  lack.of = lack.charges + circuit_.admittance() * potentials_ - supplied;
  return lack;
}

template <int dim>
bool FoundationCircuits<dim>::settle(double time, std::span<const double> state,
                                     StepOutcome &outcome) {
  if (foundations_.empty())
    return true;
  constexpr int most = 100;
  follow_step();
  const Lack lack = this->lack(time, state, outcome);
  newton_iterations_ += outcome.newton_iterations;
  if (is_found(lack)) {
    require_digits(time, lack, outcome);
    end_step(lack.charges, outcome);
    return true;
  }
  search_.see(potentials_, lack.of, probe(lack));
  require_contact(time, lack, outcome);
  if (++rounds_ == most || !lack.of.allFinite())
    throw UnsettledStep(fmt::format(
        "the potential of the foundation at t = {:g} s was not found in {} solutions of the step: "
        "its charge lacks {:.3g} of what its circuit asks for; take smaller time steps, or let the "
        "conductance fade over a longer ramp",
        time, rounds_, relative_to(lack.of.cwiseAbs().maxCoeff(), lack.sizes.maxCoeff())));
  potentials_ = search_.next();
  put_potentials();
  return false;
}

// What is left is round-off of the charges, or moves the potentials no more, or has stopped to
// fall.
template <int dim>
bool FoundationCircuits<dim>::is_found(const Lack &lack) {
  constexpr double round_off = 2 * std::numeric_limits<double>::epsilon(), nothing = 1e-13;
  const Eigen::Array<bool, Eigen::Dynamic, 1> is_round_off =
      lack.of.array().abs() <= round_off * lack.sizes.array();
  if (is_round_off.all())
    return true;
  const VectorXd left = is_round_off.select(0., lack.of);
  if (search_.knows_slope() && search_.distance(left).maxCoeff() <= nothing * probe(lack))
    return true;
  return stall_.see(is_round_off.select(0., left.cwiseAbs().cwiseQuotient(lack.sizes)).maxCoeff());
}

// Of the size of the potentials at hand.
template <int dim>
double FoundationCircuits<dim>::probe(const Lack &lack) const {
  return lack.sizes.cwiseQuotient(capacities_).maxCoeff();
}

// Where nothing touches a foundation, and nothing but the contact is connected to it, its charge is
// the same with all potentials.
template <int dim>
void FoundationCircuits<dim>::require_contact(double time, const Lack &lack,
                                              const StepOutcome &outcome) const {
  constexpr double nothing = 1e-12, left_behind = 1e-8;  // by steps that touched
  if (!search_.knows_slope())
    return;
  for (std::size_t f = 0; f < foundations_.size(); ++f) {
    const auto row = static_cast<Index>(f);
    if (touches(f, outcome) ||
        search_.slope().row(row).cwiseAbs().maxCoeff() > nothing * capacities_[row] ||
        std::abs(lack.of[row]) <= left_behind * lack.sizes[row])
      continue;
    throw SolveError(fmt::format(
        "nothing touches the foundation of contact \"{}\" at t = {:g} s, and its circuit asks for "
        "{:.6g} C on it: no potential gives it that charge. Keep the contact closed, or connect "
        "the foundation to a capacitor or a resistor",
        model_.asked.contacts[foundations_[f].contact].called(), time,
        lack.charges[row] - lack.of[row]));
  }
}

template <int dim>
bool FoundationCircuits<dim>::touches(std::size_t f, const StepOutcome &outcome) const {
  if (foundations_[f].is_linear)
    return true;
  for (std::size_t i = 0; i < model_.interface.size(); ++i)
    if (model_.interface[i].contact == foundations_[f].contact &&
        outcome.status[i] != ContactStatus::open)
      return true;
  return false;
}

// The charge is a difference of what the contact lets pass one way and the other, of which little
// is left where it conducts far better than the body behind it.
template <int dim>
void FoundationCircuits<dim>::require_digits(double time, const Lack &lack,
                                             const StepOutcome &outcome) const {
  constexpr double round_off = std::numeric_limits<double>::epsilon(), most = 1e-6;
  if (!search_.knows_slope())
    return;
  const VectorXd uncertain = lack.of.cwiseAbs() + round_off * lack.sizes;
  const VectorXd off = search_.distance(uncertain);
  for (std::size_t f = 0; f < foundations_.size(); ++f)
    if (const auto row = static_cast<Index>(f);
        !(off[row] <= most * probe(lack)) && uncertain[row] > 0 && touches(f, outcome))
      throw SolveError(fmt::format(
          "the potential of the foundation of contact \"{}\" at t = {:g} s is known to {:.2g} V of "
          "{:.6g} V only: electric.coefficient is so large beside the permittivity of the body "
          "that the "
          "charge has no digits left. A smaller one, a thousand times what the body conducts, "
          "gives the same fields and is as good a conductor; or take `solver.body = \"direct\"` "
          "where it is \"iterative\"",
          model_.asked.contacts[foundations_[f].contact].called(), time, off[row],
          potentials_[row]));
}

template <int dim>
void FoundationCircuits<dim>::put_potentials() const {
  for (std::size_t f = 0; f < foundations_.size(); ++f)
    *model_.found_potentials[foundations_[f].contact] = potentials_[static_cast<Index>(f)];
}

template <int dim>
void FoundationCircuits<dim>::end_step(const VectorXd &charges, StepOutcome &outcome) {
  outcome.newton_iterations = newton_iterations_;
  for (std::size_t f = 0; f < foundations_.size(); ++f) {
    const auto row = static_cast<Index>(f);
    outcome.foundations.push_back({foundations_[f].contact, potentials_[row], charges[row],
                                   (charges[row] - charges_[row]) / model_.step});
  }
  charges_ = charges;
  before_ = potentials_;
  rounds_ = newton_iterations_ = 0;
  stall_ = {};
  search_.end();
}

template <int dim>
void FoundationCircuits<dim>::save(output::SavedNumbers &numbers) const {
  if (foundations_.empty())
    return;
  numbers.put("foundations' charges", charges_);
  numbers.put("foundations' potentials", potentials_);
  search_.save("foundations'", numbers);
  numbers.put("foundations' step", {slope_of_step_});
}

template <int dim>
void FoundationCircuits<dim>::restore(const output::SavedNumbers &numbers) {
  if (foundations_.empty())
    return;
  numbers.fill("foundations' charges", charges_);
  numbers.fill("foundations' potentials", potentials_);
  search_.restore("foundations'", numbers);
  slope_of_step_ = numbers.get("foundations' step", 1)[0];
  before_ = potentials_;
  rounds_ = newton_iterations_ = 0;
  stall_ = {};
  put_potentials();
}

template class FoundationCircuits<2>;
template class FoundationCircuits<3>;

}  // namespace tourmaline::solve
