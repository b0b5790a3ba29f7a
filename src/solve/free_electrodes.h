#pragma once

#include <Eigen/Dense>
#include <span>
#include <vector>

#include "solve/circuit.h"
#include "solve/model.h"

namespace tourmaline::solve {

/// The electrodes whose voltage is not given while the case's state is settled (`settle`): what
/// each has come to lack of the charge that it had, beyond what its circuit brings at once.
template <int dim>
class FreeElectrodesAtStart {
 public:
  /// `given`: the case's state at t = 0. `model` outlives this. Throws CaseError.
  FreeElectrodesAtStart(const Model<dim> &model, std::span<const double> given);

  Eigen::Index size() const { return static_cast<Eigen::Index>(at_once_.free().size()); }
  /// Their voltages in a state [V].
  Eigen::VectorXd voltages(std::span<const double> state) const;
  void put(const Eigen::VectorXd &voltages, std::span<double> state) const;
  /// Q + Y V - j [C], `left` being what the state leaves of the equations (`left_at_start`).
  Eigen::VectorXd lacks(std::span<const double> state, std::span<const double> left) const;

 private:
  const Model<dim> &model_;
  Circuit at_once_;
  Eigen::VectorXd charges_, voltages_;  // of the case's state: of the free ones, of all
};

}  // namespace tourmaline::solve
