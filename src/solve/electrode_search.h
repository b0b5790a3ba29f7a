#pragma once

#include <Eigen/Dense>
#include <span>
#include <vector>

#include "output/checkpoint.h"
#include "solve/circuit.h"
#include "solve/electrode_history.h"
#include "solve/model.h"
#include "solve/probed_newton.h"
#include "solve/route.h"
#include "solve/stall.h"

namespace tourmaline::solve {

/// Voltages of the electrodes that have none given, for routes that solve a step with all of them
/// given (`ConnectedBody` eliminates them instead). With the charge Q(V) that a step solved with
/// the voltages V has on them, their circuit asks for
///
///     R(V) = Q(V) + Y V - j = 0
///
/// (`Circuit`). The body is a capacitor, so R grows with V; where the contact's status stays, it is
/// linear, and the second solution of a step is the last one (`ProbedNewton`). All ranks do the
/// same.
template <int dim>
class ElectrodeSearch {
 public:
  explicit ElectrodeSearch(const Model<dim> &model);

  /// A run begins whose initial state has been settled to this one (`settle`).
  void begin(std::span<const double> settled);
  /// Puts the voltages at hand into the state.
  void prescribe(std::span<double> state) const;
  /// Takes what the step that ends at `time` has come to with these. True: it fits; false: there
  /// are others, to take the step with again. Throws SolveError where none are found.
  bool settle(double time, std::span<const double> right_side, std::span<const double> state,
              StepOutcome &outcome);

  void save(output::SavedNumbers &numbers) const;
  void restore(const output::SavedNumbers &numbers);

 private:
  /// R of the voltages at hand, and the size of the terms that it is summed from [C].
  struct Lack {
    Eigen::VectorXd of, sizes;
  };
  void make();
  Lack lack(const Eigen::VectorXd &supplied, std::span<const double> right_side,
            std::span<const double> state) const;
  double probe(const Lack &lack) const;
  bool is_found(const Lack &lack);
  void require_answer(const Lack &lack, double time) const;

  const Model<dim> &model_;
  ElectrodeHistory<dim> history_;
  Circuit circuit_;
  double of_step_ = 0;          // k that the circuit is made for [s]
  Eigen::VectorXd capacities_;  // what a volt brings on each at the most [F]
  Eigen::VectorXd voltages_;    // of the free ones [V]
  ProbedNewton search_;
  Stall stall_;
  int rounds_ = 0, newton_iterations_ = 0;
};

}  // namespace tourmaline::solve
