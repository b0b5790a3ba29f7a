#include "solve/free_electrodes.h"

#include "solve/electrodes.h"

namespace tourmaline::solve {

using body::Fields;
using body::unknown;
using Eigen::Index;
using Eigen::VectorXd;

template <int dim>
FreeElectrodesAtStart<dim>::FreeElectrodesAtStart(const Model<dim> &model,
                                                  std::span<const double> given)
    : model_(model), at_once_(model.asked.electrodes, 0) {
  if (size() == 0)
    return;
  charges_ = initial_charges(model, given)(at_once_.free());
  voltages_ = electrode_voltages(model, given);
}

template <int dim>
VectorXd FreeElectrodesAtStart<dim>::voltages(std::span<const double> state) const {
  if (size() == 0)
    return {};
  return electrode_voltages(model_, state)(at_once_.free());
}

template <int dim>
void FreeElectrodesAtStart<dim>::put(const VectorXd &voltages, std::span<double> state) const {
  for (Index e = 0; e < size(); ++e)
    for (const body::Node node : model_.electrodes[at_once_.free()[static_cast<std::size_t>(e)]])
      state[unknown<dim>(node, Fields<dim>::potential)] = voltages[e];
}

template <int dim>
VectorXd FreeElectrodesAtStart<dim>::lacks(std::span<const double> state,
                                           std::span<const double> left) const {
  if (size() == 0)
    return {};
  const VectorXd now = electrode_voltages(model_, state);
  VectorXd lacks = at_once_.admittance() * now(at_once_.free()) -
                   at_once_.right_side(sources_before_start(model_), 0, charges_, voltages_, now);
  for (Index e = 0; e < size(); ++e)
    for (const body::Node node : model_.electrodes[at_once_.free()[static_cast<std::size_t>(e)]])
      lacks[e] += left[unknown<dim>(node, Fields<dim>::potential)];
  return lacks;
}

template class FreeElectrodesAtStart<2>;
template class FreeElectrodesAtStart<3>;

}  // namespace tourmaline::solve
