#pragma once

#include <Eigen/Dense>
#include <optional>
#include <vector>

#include "tourmaline/case/boundary_case.h"

namespace tourmaline::solve {

/// What is connected to the electrodes whose voltage is not given, the free ones, over steps of
/// length k by backward Euler. Their charges Q and voltages V obey
///
///     Q_n + Y V_n = j_n,
///
/// Kirchhoff's law for the charge that has come in during the step. A resistor R adds k / R and a
/// capacitor C adds C to Y, which is symmetric and not negative; an electrode with given charge,
/// and an open one, has a row of zeros. A step of 0 is what happens at once: charge comes in
/// through capacitors, and none through resistors.
class Circuit {
 public:
  Circuit(const std::vector<casefile::ElectrodeCase> &electrodes, double step);

  /// The free electrodes among those of the case.
  const std::vector<std::size_t> &free() const { return free_; }
  /// Y [F]
  const Eigen::MatrixXd &admittance() const { return admittance_; }
  /// j_n [C] for the step from the time `before` to `time`; `charges` are those of the free
  /// electrodes at the last step, `voltages_before` and `voltages` those of all electrodes at the
  /// last step and now (of which only the given ones are read). `before` is nothing where what was
  /// before is the case's initial state: sources are switched on at t = 0, and were at 0 V.
  Eigen::VectorXd right_side(std::optional<double> before, double time,
                             const Eigen::VectorXd &charges, const Eigen::VectorXd &voltages_before,
                             const Eigen::VectorXd &voltages) const;

 private:
  // A resistor and a capacitor, parallel, from an electrode to another, or to a given voltage.
  struct Branch {
    std::size_t from;
    std::optional<std::size_t> to;
    casefile::Formula voltage;  // of the other end, where it is no electrode
    double leak, capacitance;   // k / R and C [F]
  };
  std::optional<Eigen::Index> row_of(std::size_t electrode) const;
  void add(const Branch &branch);

  std::vector<std::size_t> free_;
  std::vector<std::optional<casefile::Formula>> given_charge_;  // by free electrode
  std::vector<Branch> branches_;
  Eigen::MatrixXd admittance_;
};

}  // namespace tourmaline::solve
