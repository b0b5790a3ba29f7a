#include "solve/probed_newton.h"

#include <cmath>
#include <limits>

namespace tourmaline::solve {

using Eigen::Index;
using Eigen::VectorXd;

VectorXd ProbedNewton::distance(const VectorXd &residual) const {
  return slope_.fullPivLu().isInvertible()
             ? VectorXd(slope_.fullPivLu().solve(residual).cwiseAbs())
             : VectorXd::Constant(residual.size(), std::numeric_limits<double>::infinity());
}

// From one probe to the next, and from the last one back to where they began.
VectorXd ProbedNewton::probe_on(const VectorXd &residual, double probe) {
  if (probed_ >= 0)
    slope_.col(probed_) = (residual - residual_) / probe_;
  VectorXd x = x_;
  if (++probed_ < x.size()) {
    probe_ = probe;
    x[probed_] += probe;
    return x;
  }
  probed_ = -1;
  knows_slope_ = true;
  return x - slope_.partialPivLu().solve(residual_);
}

// What has led away is half taken back.
VectorXd ProbedNewton::next(const VectorXd &x, const VectorXd &residual, double probe) {
  if (!knows_slope_) {
    if (probed_ < 0) {
      x_ = x;
      residual_ = residual;
    }
    return probe_on(residual, probe);
  }
  constexpr double far = 1e-4;  // below it the difference of two residuals has too few digits
  if (x_.size() > 0 && (x - x_).norm() > far * std::abs(probe))
    update(x, residual);
  if (residual_.size() > 0 && residual.norm() > 2 * residual_.norm())
    return (x_ + x) / 2;
  x_ = x;
  residual_ = residual;
  return x - slope_.partialPivLu().solve(residual);
}

void ProbedNewton::update(const VectorXd &x, const VectorXd &residual) {
  const VectorXd moved = x - x_;
  slope_ += (residual - residual_ - slope_ * moved) * moved.transpose() / moved.squaredNorm();
}

void ProbedNewton::end() {
  probed_ = -1;
  x_.resize(0);
  residual_.resize(0);
}

void ProbedNewton::save(const std::string &name, output::SavedNumbers &numbers) const {
  numbers.put(name + " slope", VectorXd(slope_.reshaped()));
  numbers.put(name + " knows slope", {double(knows_slope_)});
}

void ProbedNewton::restore(const std::string &name, const output::SavedNumbers &numbers) {
  VectorXd slope(slope_.size());
  numbers.fill(name + " slope", slope);
  slope_ = slope.reshaped(slope_.rows(), slope_.cols());
  knows_slope_ = numbers.get(name + " knows slope", 1)[0] != 0;
  end();
}

}  // namespace tourmaline::solve
