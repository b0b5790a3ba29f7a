#pragma once

#include <Eigen/Dense>
#include <span>
#include <utility>
#include <vector>

#include "output/checkpoint.h"
#include "solve/circuit.h"
#include "solve/model.h"
#include "solve/probed_newton.h"
#include "solve/route.h"
#include "solve/stall.h"

namespace tourmaline::solve {

/// Foundations whose potentials follow from circuits. With the charge Q(V) = -integral of D.nu that
/// a step solved with potentials V has on them, the circuit asks for
///
///     R(V) = Q(V) + Y V - j = 0
///
/// (`Circuit`). Body and contact are a capacitor whose charge grows with V, so R does as well.
/// Where the contact's status stays, R is linear, and the second solution of a step is the last
/// one (`ProbedNewton`). All ranks do the same.
template <int dim>
class FoundationCircuits {
 public:
  /// `model` outlives this; its found potentials are set from here.
  explicit FoundationCircuits(const Model<dim> &model);

  /// From the case's state at t = 0, at which the potentials are 0.
  void begin(std::span<const double> initial);

  /// A dynamic run settles that state (`settle`): what lacks each foundation at its potential, of
  /// what its circuit brings at once, R of above for a step of 0 [C].
  Eigen::VectorXd lacks_at_start(std::span<const double> state) const;
  const Eigen::VectorXd &potentials() const { return potentials_; }
  void put_at_start(const Eigen::VectorXd &potentials);
  /// It is settled: the first step goes on from there.
  void begin_settled();

  /// Takes what the step that ends at `time` has come to with the potentials at hand. True: it
  /// fits, and `outcome` knows what the foundations have; false: there are other potentials, to
  /// take the step with again. Throws SolveError after many of them.
  bool settle(double time, std::span<const double> state, StepOutcome &outcome);

  void save(output::SavedNumbers &numbers) const;
  void restore(const output::SavedNumbers &numbers);

 private:
  /// What a contact's charge is summed from.
  struct Foundation {
    std::size_t contact = 0;
    bool is_linear = false, accumulates = false;
    std::vector<std::pair<body::Node, double>> weights;  // integral of c N_i, or c w_i [F]
    double capacitance = 0;                              // their sum
  };
  static std::vector<casefile::ElectrodeCase> as_electrodes(
      const std::vector<casefile::ContactCase> &contacts);
  void make();
  void follow_step();
  Foundation foundation(std::size_t contact) const;
  double charge_at_start(std::size_t f, std::span<const double> state) const;
  Eigen::VectorXd brought_at_once() const;
  double crossed(std::size_t f, std::span<const double> state, const StepOutcome &outcome) const;
  double size(std::size_t f, std::span<const double> state) const;
  /// R of the potentials at hand [C], by foundation.
  struct Lack {
    Eigen::VectorXd of, charges;
    Eigen::VectorXd sizes;  // of the terms that they were summed from
  };
  Lack lack(double time, std::span<const double> state, const StepOutcome &outcome) const;
  bool is_found(const Lack &lack);
  double probe(const Lack &lack) const;
  void require_contact(double time, const Lack &lack, const StepOutcome &outcome) const;
  bool touches(std::size_t f, const StepOutcome &outcome) const;
  void require_digits(double time, const Lack &lack, const StepOutcome &outcome) const;
  void put_potentials() const;
  void end_step(const Eigen::VectorXd &charges, StepOutcome &outcome);

  const Model<dim> &model_;
  double of_step_ = 0;  // k that the following is made for [s]
  std::vector<Foundation> foundations_;
  Circuit circuit_;
  Eigen::VectorXd capacities_;        // what a volt brings on each at the most [F]
  Eigen::VectorXd charges_, before_;  // at the end of the last step: Q [C], V [V]
  ProbedNewton search_{0};
  double slope_of_step_ = 0;  // k with which it knows the slope of R [s]
  // Of the step at hand:
  Eigen::VectorXd potentials_;  // V
  int rounds_ = 0, newton_iterations_ = 0;
  Stall stall_;
};

}  // namespace tourmaline::solve
