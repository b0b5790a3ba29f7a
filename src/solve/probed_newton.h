#pragma once

#include <Eigen/Dense>
#include <string>

#include "output/checkpoint.h"

namespace tourmaline::solve {

/// Looks for the root of a residual R(x) of few unknowns that is dear to evaluate and mostly
/// linear. Its derivative comes from probes, x with one component changed at a time, and is kept
/// from one search to the next; Broyden's update follows where R bends, and where what is kept
/// does not lead on, R is probed again. Components that move nothing stay where they are.
class ProbedNewton {
 public:
  explicit ProbedNewton(Eigen::Index n) : sizes_(Eigen::VectorXd::Ones(n)), slope_(n, n) {}

  /// What a change of x by 1 brings to each component of R at the most, > 0: by it they compare.
  void set_sizes(const Eigen::VectorXd &sizes) { sizes_ = sizes; }

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
  /// R has changed by a linear function of x.
  void add_to_slope(const Eigen::MatrixXd &change) { slope_ += change; }
  /// By how much x is off with such a residual, by component; infinite where nothing moves that
  /// component of R.
  Eigen::VectorXd distance(const Eigen::VectorXd &residual) const;

  void save(const std::string &name, output::SavedNumbers &numbers) const;
  void restore(const std::string &name, const output::SavedNumbers &numbers);

 private:
  void see_probe(const Eigen::VectorXd &x, const Eigen::VectorXd &residual);
  bool leads_on(const Eigen::VectorXd &residual) const;
  Eigen::VectorXd step_for(const Eigen::VectorXd &residual) const;
  void update(const Eigen::VectorXd &x, const Eigen::VectorXd &residual);

  double norm(const Eigen::VectorXd &residual) const {
    return residual.cwiseQuotient(sizes_).norm();
  }

  Eigen::VectorXd sizes_;
  Eigen::MatrixXd slope_;
  bool knows_slope_ = false;
  // Of the search at hand:
  bool has_probed_ = false;
  Eigen::Index probed_ = -1;  // component that the next probe changes; -1: none
  double probe_ = 0;
  Eigen::VectorXd x_, residual_;  // of the best point that is no probe
  Eigen::VectorXd halfway_;       // to one that is worse; empty: there is none
};

}  // namespace tourmaline::solve
