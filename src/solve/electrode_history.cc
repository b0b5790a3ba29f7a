#include "solve/electrode_history.h"

#include <utility>

#include "body/prescribed.h"
#include "solve/electrodes.h"

namespace tourmaline::solve {

using Eigen::VectorXd;

template <int dim>
ElectrodeHistory<dim>::ElectrodeHistory(const Model<dim> &model) : model_(model) {
  const Circuit circuit(model.asked.electrodes, model.step);
  if (circuit.free().empty())
    return;
  const std::vector<double> initial = body::initial_state(model.body, model.asked.initial);
  voltages_ = electrode_voltages(model, initial);
  charges_ = initial_charges(model, initial)(circuit.free());
  voltages_before_ = voltages_;
  charges_before_ = charges_;
}

// What comes in at once is exact, as reactions of the settled state are not: an open electrode
// keeps its charge to the last bit.
template <int dim>
void ElectrodeHistory<dim>::begin(std::span<const double> settled) {
  const Circuit at_once(model_.asked.electrodes, 0);
  if (at_once.free().empty())
    return;
  const VectorXd now = electrode_voltages(model_, settled);
  charges_ = at_once.right_side(sources_before_start(model_), 0, charges_, voltages_, now) -
             at_once.admittance() * now(at_once.free());
  voltages_ = now;
  voltages_before_ = voltages_;
  charges_before_ = charges_;
}

template <int dim>
VectorXd ElectrodeHistory<dim>::supplied(const Circuit &circuit, double time,
                                         std::span<const double> state) const {
  return circuit.right_side(sources_before(model_, time), time, charges_, voltages_,
                            electrode_voltages(model_, state));
}

template <int dim>
void ElectrodeHistory<dim>::end_step(const Circuit &circuit, const VectorXd &supplied,
                                     std::span<const double> state) {
  voltages_before_ = std::exchange(voltages_, electrode_voltages(model_, state));
  charges_before_ =
      std::exchange(charges_, supplied - circuit.admittance() * voltages_(circuit.free()));
}

template <int dim>
void ElectrodeHistory<dim>::take_back() {
  charges_ = charges_before_;
  voltages_ = voltages_before_;
}

template <int dim>
void ElectrodeHistory<dim>::save(output::SavedNumbers &numbers) const {
  numbers.put("free electrodes' charges", charges_);
  numbers.put("electrodes' voltages", voltages_);
}

template <int dim>
void ElectrodeHistory<dim>::restore(const output::SavedNumbers &numbers) {
  numbers.fill("free electrodes' charges", charges_);
  numbers.fill("electrodes' voltages", voltages_);
}

template class ElectrodeHistory<2>;
template class ElectrodeHistory<3>;

}  // namespace tourmaline::solve
