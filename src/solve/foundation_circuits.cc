#include "solve/foundation_circuits.h"

#include <fmt/format.h>

#include <cmath>

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
    : model_(model),
      of_step_(model.step),
      circuit_(as_electrodes(model.asked.contacts), model.step) {
  for (std::size_t c = 0; c < model.found_potentials.size(); ++c)
    if (model.found_potentials[c])
      foundations_.push_back(foundation(c));
  charges_ = before_ = potentials_ = VectorXd::Zero(static_cast<Index>(foundations_.size()));
  put_potentials();
  forget_slope();
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
void FoundationCircuits<dim>::follow_step() {
  if (model_.step == of_step_)
    return;
  of_step_ = model_.step;
  circuit_ = Circuit(as_electrodes(model_.asked.contacts), of_step_);
  for (Foundation &one : foundations_)
    one = foundation(one.contact);
  forget_slope();
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

// What a sum of charges is made of, by which its round-off is measured.
template <int dim>
double FoundationCircuits<dim>::size(std::size_t f, std::span<const double> state) const {
  const Foundation &of = foundations_[f];
  const auto row = static_cast<Index>(f);
  double size = (of.capacitance + circuit_.admittance()(row, row)) * std::abs(potentials_[row]);
  for (const auto &[node, weight] : of.weights)
    size += weight * std::abs(state[unknown<dim>(node, Fields<dim>::potential)]);
  return size;
}

template <int dim>
bool FoundationCircuits<dim>::settle(double time, std::span<const double> state,
                                     StepOutcome &outcome) {
  if (foundations_.empty())
    return true;
  constexpr int most = 100;
  constexpr double tolerance = 1e-13;
  follow_step();
  const VectorXd supplied =
      circuit_.right_side(sources_before(model_, time), time, charges_, before_, potentials_);
  VectorXd charges(potentials_.size());
  double sizes = 0;
  for (std::size_t f = 0; f < foundations_.size(); ++f) {
    charges[static_cast<Index>(f)] = -crossed(f, state, outcome);
    sizes = larger(sizes, size(f, state) + std::abs(supplied[static_cast<Index>(f)]));
  }
  const VectorXd lacks = charges + circuit_.admittance() * potentials_ - supplied;
  const double lack = relative_to(lacks.cwiseAbs().maxCoeff(), sizes);
  newton_iterations_ += outcome.newton_iterations;
  if (lack <= tolerance || stall_.see(lack)) {
    end_step(charges, outcome);
    return true;
  }
  if (++rounds_ == most || !std::isfinite(lack))
    throw SolveError(fmt::format(
        "the potential of the foundation at t = {:g} s was not found in {} solutions of the step: "
        "its charge lacks {:.3g} of what its circuit asks for; take smaller time steps, or let the "
        "conductance fade over a longer ramp",
        time, rounds_, lack));
  improve(lacks, lack);
  return false;
}

// Broyden's update, forgotten where it leads nowhere: the slope at the start is more than that of
// R, with which each round goes in the right direction, if not far. Near round-off it is kept.
template <int dim>
void FoundationCircuits<dim>::improve(const VectorXd &lacks, double lack) {
  constexpr double near_round_off = 1e-8;
  if (rounds_ > 1 && lack > near_round_off) {
    const VectorXd moved = potentials_ - tried_;
    const VectorXd more = lacks - lacked_ - slope_ * moved;
    slope_ += more * moved.transpose() / moved.squaredNorm();
    if (!(lacks.norm() < 2 * lacked_.norm()))
      forget_slope();
  }
  tried_ = potentials_;
  lacked_ = lacks;
  VectorXd change = slope_.partialPivLu().solve(lacks);
  if (!change.allFinite() || change.dot(lacks) <= 0) {
    forget_slope();
    change = slope_.partialPivLu().solve(lacks);
  }
  potentials_ -= change;
  put_potentials();
}

template <int dim>
void FoundationCircuits<dim>::forget_slope() {
  slope_ = circuit_.admittance();
  for (std::size_t f = 0; f < foundations_.size(); ++f)
    slope_(static_cast<Index>(f), static_cast<Index>(f)) += foundations_[f].capacitance;
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
}

template <int dim>
void FoundationCircuits<dim>::save(output::SavedNumbers &numbers) const {
  if (foundations_.empty())
    return;
  numbers.put("foundations' charges", charges_);
  numbers.put("foundations' potentials", potentials_);
  numbers.put("foundations' slope", VectorXd(slope_.reshaped()));
}

template <int dim>
void FoundationCircuits<dim>::restore(const output::SavedNumbers &numbers) {
  if (foundations_.empty())
    return;
  numbers.fill("foundations' charges", charges_);
  numbers.fill("foundations' potentials", potentials_);
  VectorXd slope(slope_.size());
  numbers.fill("foundations' slope", slope);
  slope_ = slope.reshaped(slope_.rows(), slope_.cols());
  before_ = potentials_;
  put_potentials();
}

template class FoundationCircuits<2>;
template class FoundationCircuits<3>;

}  // namespace tourmaline::solve
