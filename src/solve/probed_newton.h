#pragma once

#include <Eigen/Dense>
#include <string>

#include "output/checkpoint.h"

namespace tourmaline::solve {

/// Looks for the root of a residual R(x) of few unknowns that is dear to evaluate and mostly
/// linear. Its derivative comes from probes, x with one component changed at a time, and is kept
/// from one search to the next; Broyden's update follows where R bends.
class ProbedNewton {
 public:
  explicit ProbedNewton(Eigen::Index n) : slope_(n, n) {}

  /// Where to evaluate R next, having evaluated it at x. A probe changes a component by `probe`.
  Eigen::VectorXd next(const Eigen::VectorXd &x, const Eigen::VectorXd &residual, double probe);
  /// The next search may begin somewhere else.
  void end();
  void forget() { knows_slope_ = false; }

  bool knows_slope() const { return knows_slope_; }
  const Eigen::MatrixXd &slope() const { return slope_; }
  /// By how much x is off with such a residual, by component; not finite where nothing moves R.
  Eigen::VectorXd distance(const Eigen::VectorXd &residual) const;

  void save(const std::string &name, output::SavedNumbers &numbers) const;
  void restore(const std::string &name, const output::SavedNumbers &numbers);

 private:
  Eigen::VectorXd probe_on(const Eigen::VectorXd &residual, double probe);
  void update(const Eigen::VectorXd &x, const Eigen::VectorXd &residual);

  Eigen::MatrixXd slope_;
  bool knows_slope_ = false;
  // Of the search at hand:
  Eigen::Index probed_ = -1;  // component; -1: none
  double probe_ = 0;
  Eigen::VectorXd x_, residual_;  // of the last point that is no probe
};

}  // namespace tourmaline::solve
