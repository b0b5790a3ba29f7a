#pragma once

#include <Eigen/Dense>
#include <span>

#include "output/checkpoint.h"
#include "solve/circuit.h"
#include "solve/model.h"

namespace tourmaline::solve {

/// Charges and voltages that the free electrodes have come to by the end of the last step.
template <int dim>
class ElectrodeHistory {
 public:
  /// Of the case's initial state.
  explicit ElectrodeHistory(const Model<dim> &model);

  /// A run begins whose initial state has been settled to this one (`settle`).
  void begin(std::span<const double> settled);
  /// j of the step that ends at `time` [C]; of `state` the given voltages are read.
  Eigen::VectorXd supplied(const Circuit &circuit, double time,
                           std::span<const double> state) const;
  /// The step has come to that state.
  void end_step(const Circuit &circuit, const Eigen::VectorXd &supplied,
                std::span<const double> state);
  /// It is to be solved again.
  void take_back();

  const Eigen::VectorXd &voltages() const { return voltages_; }

  void save(output::SavedNumbers &numbers) const;
  void restore(const output::SavedNumbers &numbers);

 private:
  const Model<dim> &model_;
  Eigen::VectorXd charges_, voltages_;  // of the free electrodes, of all
  Eigen::VectorXd charges_before_, voltages_before_;
};

}  // namespace tourmaline::solve
