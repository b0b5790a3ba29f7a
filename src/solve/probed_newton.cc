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

void ProbedNewton::see_probe(const VectorXd &x, const VectorXd &residual) {
  if (probed_ < 0) {
    x_ = x;
    residual_ = residual;
  } else {
    slope_.col(probed_) = (residual - residual_) / probe_;
  }
  if (++probed_ < x.size())
    return;
  probed_ = -1;
  knows_slope_ = true;
}

void ProbedNewton::see(const VectorXd &x, const VectorXd &residual, double probe) {
  constexpr double far = 1e-4;  // below it the difference of two residuals has too few digits
  if (!knows_slope_) {
    see_probe(x, residual);
    probe_ = probe;
    return;
  }
  const bool goes_on = x_.size() > 0;
  if (goes_on && (x - x_).norm() > far * std::abs(probe))
    update(x, residual);
  halfway_.resize(0);
  if (goes_on && residual.norm() > 2 * residual_.norm()) {
    halfway_ = (x_ + x) / 2;
    return;
  }
  x_ = x;
  residual_ = residual;
}

VectorXd ProbedNewton::next() const {
  if (knows_slope_)
    return halfway_.size() > 0 ? halfway_ : VectorXd(x_ - slope_.partialPivLu().solve(residual_));
  VectorXd x = x_;
  x[probed_] += probe_;
  return x;
}

void ProbedNewton::update(const VectorXd &x, const VectorXd &residual) {
  const VectorXd moved = x - x_;
  slope_ += (residual - residual_ - slope_ * moved) * moved.transpose() / moved.squaredNorm();
}

void ProbedNewton::end() {
  probed_ = -1;
  x_.resize(0);
  residual_.resize(0);
  halfway_.resize(0);
}

void ProbedNewton::forget() {
  knows_slope_ = false;
  end();
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
