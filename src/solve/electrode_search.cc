#include "solve/electrode_search.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "larger.h"
#include "solve/electrodes.h"
#include "tourmaline/error.h"

namespace tourmaline::solve {

using body::Fields;
using body::unknown;
using Eigen::Index;
using Eigen::VectorXd;

template <int dim>
ElectrodeSearch<dim>::ElectrodeSearch(const Model<dim> &model)
    : model_(model),
      history_(model),
      circuit_(model.asked.electrodes, model.step),
      voltages_(history_.voltages()(circuit_.free())),
      search_(voltages_.size()) {
  make();
}

// A volt on an electrode with all else at rest draws more charge than with the body at its will.
template <int dim>
void ElectrodeSearch<dim>::make() {
  if (of_step_ > 0 && search_.knows_slope())
    search_.add_to_slope(Circuit(model_.asked.electrodes, model_.step).admittance() -
                         circuit_.admittance());
  of_step_ = model_.step;
  circuit_ = Circuit(model_.asked.electrodes, of_step_);
  capacities_ = circuit_.admittance().diagonal();
  const std::vector<double> nothing(model_.n_unknowns(), 0.);
  for (Index e = 0; e < voltages_.size(); ++e) {
    const std::size_t electrode = circuit_.free()[static_cast<std::size_t>(e)];
    std::vector<double> volt = nothing;
    for (const body::Node node : model_.electrodes[electrode])
      volt[unknown<dim>(node, Fields<dim>::potential)] = 1;
    capacities_[e] += electrode_charges<dim>(model_, model_.product(volt, false),
                                             nothing)[static_cast<Index>(electrode)];
  }
  search_.set_sizes(capacities_);
}

template <int dim>
void ElectrodeSearch<dim>::begin(std::span<const double> settled) {
  history_.begin(settled);
  voltages_ = history_.voltages()(circuit_.free());
}

template <int dim>
void ElectrodeSearch<dim>::prescribe(std::span<double> state) const {
  for (Index e = 0; e < voltages_.size(); ++e)
    for (const body::Node node : model_.electrodes[circuit_.free()[static_cast<std::size_t>(e)]])
      state[unknown<dim>(node, Fields<dim>::potential)] = voltages_[e];
}

template <int dim>
typename ElectrodeSearch<dim>::Lack ElectrodeSearch<dim>::lack(
    const VectorXd &supplied, std::span<const double> right_side,
    std::span<const double> state) const {
  const std::vector<double> product = model_.product({state.data(), state.size()}, true);
  const VectorXd charges = electrode_charges<dim>(model_, product, right_side)(circuit_.free());
  double largest = 0;
  for (std::size_t i = Fields<dim>::potential; i < state.size(); i += Fields<dim>::count)
    largest = std::max(largest, std::abs(state[i]));
  largest = model_.sharing().largest(largest);
  return {charges + circuit_.admittance() * voltages_ - supplied,
          largest * capacities_ + charges.cwiseAbs() + supplied.cwiseAbs()};
}

// As a voltage.
template <int dim>
double ElectrodeSearch<dim>::probe(const Lack &lack) const {
  return lack.sizes.cwiseQuotient(capacities_).maxCoeff();
}

// What is left is round-off of the charges, or moves the voltages no more, or has stopped to fall.
template <int dim>
bool ElectrodeSearch<dim>::is_found(const Lack &lack) {
  constexpr double round_off = 2 * std::numeric_limits<double>::epsilon(), nothing = 1e-13;
  if ((lack.of.array().abs() <= round_off * lack.sizes.array()).all())
    return true;
  if (search_.knows_slope() && search_.distance(lack.of).maxCoeff() <= nothing * probe(lack))
    return true;
  return stall_.see(lack.of.cwiseAbs().cwiseQuotient(lack.sizes).maxCoeff());
}

template <int dim>
void ElectrodeSearch<dim>::require_answer(const Lack &lack, double time) const {
  constexpr double nothing = 1e-12;
  constexpr int most = 100;
  const bool is_loose = search_.knows_slope() &&
                        (search_.slope().rowwise().template lpNorm<Eigen::Infinity>().array() <=
                         nothing * capacities_.array())
                            .any();
  if (is_loose)
    throw SolveError(
        "the charges on the electrodes do not determine their voltages; does every "
        "electrode see a given voltage through the body or its circuit?");
  if (rounds_ < most && lack.of.allFinite())
    return;
  throw UnsettledStep(fmt::format(
      "the voltages of the electrodes at t = {:g} s were not found in {} solutions of the step: "
      "their charges lack {:.3g} of what the circuit asks for; take smaller time steps, or "
      "solver.method = \"condensed\" with solver.body = \"direct\", which needs no search",
      time, rounds_, relative_to(lack.of.cwiseAbs().maxCoeff(), lack.sizes.maxCoeff())));
}

template <int dim>
bool ElectrodeSearch<dim>::settle(double time, std::span<const double> right_side,
                                  std::span<const double> state, StepOutcome &outcome) {
  if (of_step_ != model_.step)
    make();
  const VectorXd supplied = history_.supplied(circuit_, time, state);
  const Lack lack = this->lack(supplied, right_side, state);
  newton_iterations_ += outcome.newton_iterations;
  if (is_found(lack)) {
    history_.end_step(circuit_, supplied, state);
    outcome.newton_iterations = newton_iterations_;
    rounds_ = newton_iterations_ = 0;
    stall_ = {};
    search_.end();
    return true;
  }
  ++rounds_;
  search_.see(voltages_, lack.of, probe(lack));
  require_answer(lack, time);
  voltages_ = search_.next();
  return false;
}

template <int dim>
void ElectrodeSearch<dim>::save(output::SavedNumbers &numbers) const {
  history_.save(numbers);
  search_.save("electrodes'", numbers);
  numbers.put("electrodes' step", {of_step_});
}

template <int dim>
void ElectrodeSearch<dim>::restore(const output::SavedNumbers &numbers) {
  history_.restore(numbers);
  search_.restore("electrodes'", numbers);
  of_step_ = numbers.get("electrodes' step", 1)[0];
  circuit_ = Circuit(model_.asked.electrodes, of_step_);
  voltages_ = history_.voltages()(circuit_.free());
  rounds_ = newton_iterations_ = 0;
  stall_ = {};
}

template class ElectrodeSearch<2>;
template class ElectrodeSearch<3>;

}  // namespace tourmaline::solve
