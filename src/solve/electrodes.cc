#include "solve/electrodes.h"

#include <fmt/format.h>

#include <cmath>

#include "solve/leaked_charge.h"
#include "tourmaline/error.h"

namespace tourmaline::solve {

using body::Fields;
using body::unknown;
using Eigen::Index;
using Eigen::VectorXd;

template <int dim>
VectorXd electrode_charges(const Model<dim> &model, std::span<const double> products,
                           std::span<const double> loads) {
  VectorXd charges = VectorXd::Zero(static_cast<Index>(model.electrodes.size()));
  for (std::size_t e = 0; e < model.electrodes.size(); ++e)
    for (const body::Node node : model.electrodes[e]) {
      const std::size_t i = unknown<dim>(node, Fields<dim>::potential);
      charges[static_cast<Index>(e)] -= products[i] - loads[i];
    }
  return charges;
}

template <int dim>
VectorXd electrode_voltages(const Model<dim> &model, std::span<const double> state) {
  VectorXd voltages(static_cast<Index>(model.electrodes.size()));
  for (std::size_t e = 0; e < model.electrodes.size(); ++e) {
    const auto potential = [&](body::Node node) {
      return state[unknown<dim>(node, Fields<dim>::potential)];
    };
    const double voltage = potential(model.electrodes[e].front());
    for (const body::Node node : model.electrodes[e])
      if (std::abs(potential(node) - voltage) > 1e-9 * std::abs(voltage))
        throw CaseError(fmt::format(
            "{} \"{}\": the initial potential is {:g} V at one of its nodes and {:g} V at another, "
            "but an electrode has one potential; change [initial] potential",
            model.asked.electrodes[e].where, model.asked.electrodes[e].name, voltage,
            potential(node)));
    voltages[static_cast<Index>(e)] = voltage;
  }
  return voltages;
}

namespace {

// What an electrode keeps does not change with the mesh by which its field is approximated.
template <int dim>
VectorXd kept_charges(const Model<dim> &model, VectorXd charges) {
  const auto &kept = model.asked.initial.charges;
  for (std::size_t e = 0; e < model.electrodes.size(); ++e)
    if (const auto found = kept.find(model.asked.electrodes[e].name); found != kept.end())
      charges[static_cast<Index>(e)] = found->second;
  return charges;
}

// Nothing has leaked before t = 0, though the products and loads are those of a step that leaks.
template <int dim>
VectorXd charges_before_leaks(const Model<dim> &model, std::optional<double> time,
                              std::span<const double> state, std::span<const double> products,
                              std::vector<double> loads) {
  if (model.laws.remembers_charge()) {
    const std::vector<double> leaks = leaking(model, time, state);
    for (std::size_t node = 0; node < leaks.size(); ++node)
      loads[unknown<dim>(static_cast<body::Node>(node), Fields<dim>::potential)] -= leaks[node];
  }
  return electrode_charges<dim>(model, products, loads);
}

}  // namespace

template <int dim>
VectorXd initial_charges(const Model<dim> &model, std::span<const double> initial) {
  if (model.asked.initial.from)
    return kept_charges(model, settled_charges(model, initial));
  std::vector<double> products(initial.size());
  const std::vector<double> no_loads(initial.size(), 0.);
  model.op.multiply(model.step, initial, products);
  return charges_before_leaks<dim>(model, std::nullopt, initial, products, no_loads);
}

template <int dim>
VectorXd settled_charges(const Model<dim> &model, std::span<const double> settled) {
  std::vector<double> products(settled.size()), loads(settled.size(), 0.);
  model.op.multiply(model.step, settled, products);
  model.loads.integrate(0, loads);
  return charges_before_leaks<dim>(model, 0, settled, products, loads);
}

template <int dim>
std::optional<double> sources_before_start(const Model<dim> &model) {
  return model.asked.initial.from ? std::optional(0.) : std::nullopt;
}

template <int dim>
std::optional<double> sources_before(const Model<dim> &model, double time) {
  if (model.steps.number(time) == 1 && !model.asked.time.is_dynamic())
    return sources_before_start(model);
  return model.time_before(time);
}

template VectorXd electrode_charges<2>(const Model<2> &, std::span<const double>,
                                       std::span<const double>);
template VectorXd electrode_charges<3>(const Model<3> &, std::span<const double>,
                                       std::span<const double>);
template VectorXd electrode_voltages<2>(const Model<2> &, std::span<const double>);
template VectorXd electrode_voltages<3>(const Model<3> &, std::span<const double>);
template VectorXd initial_charges<2>(const Model<2> &, std::span<const double>);
template VectorXd initial_charges<3>(const Model<3> &, std::span<const double>);
template VectorXd settled_charges<2>(const Model<2> &, std::span<const double>);
template VectorXd settled_charges<3>(const Model<3> &, std::span<const double>);
template std::optional<double> sources_before_start(const Model<2> &);
template std::optional<double> sources_before_start(const Model<3> &);
template std::optional<double> sources_before(const Model<2> &, double);
template std::optional<double> sources_before(const Model<3> &, double);

}  // namespace tourmaline::solve
