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

  /// R has been evaluated at x, where the last `next` wanted it or where the search begins; a
  /// probe is to change a component by `probe`.
  void see(const Eigen::VectorXd &x, const Eigen::VectorXd &residual, double probe);
  /// Where to evaluate R next.
  Eigen::VectorXd next() const;
  /// The next search may begin somewhere else.
  void end();
  void forget();

  bool knows_slope() const { return knows_slope_; }
  const Eigen::MatrixXd &slope() const { return slope_; }
  /// By how much x is off with such a residual, by component; infinite where nothing moves R.
  Eigen::VectorXd distance(const Eigen::VectorXd &residual) const;

  void save(const std::string &name, output::SavedNumbers &numbers) const;
  void restore(const std::string &name, const output::SavedNumbers &numbers);

 private:
  void see_probe(const Eigen::VectorXd &x, const Eigen::VectorXd &residual);
  void update(const Eigen::VectorXd &x, const Eigen::VectorXd &residual);

  Eigen::MatrixXd slope_;
  bool knows_slope_ = false;
  // Of the search at hand:
  Eigen::Index probed_ = -1;  // component that the next probe changes; -1: none
  double probe_ = 0;
  Eigen::VectorXd x_, residual_;  // of the best point that is no probe
  Eigen::VectorXd halfway_;       // to one that is worse; empty: there is none
};

}  // namespace tourmaline::solve
