#include "solve/probed_newton.h"

#include <cmath>
#include <limits>

#include "dense/decompositions.h"

namespace tourmaline::solve {

using Eigen::Index;
using Eigen::VectorXd;

VectorXd ProbedNewton::step_for(const VectorXd &residual) const {
  const Eigen::MatrixXd scaled = sizes_.cwiseInverse().asDiagonal() * slope_;
  return dense::least_squares(scaled, residual.cwiseQuotient(sizes_));
}

VectorXd ProbedNewton::distance(const VectorXd &residual) const {
  constexpr double some = 1e-3;
  const VectorXd step = step_for(residual), left = residual - slope_ * step;
  return (left.array().abs() > some * residual.array().abs())
      .select(VectorXd::Constant(step.size(), std::numeric_limits<double>::infinity()),
              step.cwiseAbs());
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
  knows_slope_ = has_probed_ = true;
}

void ProbedNewton::see(const VectorXd &x, const VectorXd &residual, double probe) {
  constexpr double far = 1e-4;  // below it the difference of two residuals has too few digits
  const bool goes_on = x_.size() > 0;
  if (knows_slope_ && !has_probed_ && !leads_on(residual))
    forget();
  if (!knows_slope_) {
    see_probe(x, residual);
    probe_ = probe;
    return;
  }
  if (goes_on && (x - x_).norm() > far * std::abs(probe))
    update(x, residual);
  halfway_.resize(0);
  if (goes_on && norm(residual) > 2 * norm(residual_)) {
    halfway_ = (x_ + x) / 2;
    return;
  }
  x_ = x;
  residual_ = residual;
}

// A slope of an earlier search, of which parts may have been 0 then.
bool ProbedNewton::leads_on(const VectorXd &residual) const {
  constexpr double half = 0.5;
  return distance(residual).allFinite() &&
         (x_.size() == 0 || norm(residual) < half * norm(residual_));
}

VectorXd ProbedNewton::next() const {
  if (knows_slope_)
    return halfway_.size() > 0 ? halfway_ : VectorXd(x_ - step_for(residual_));
  VectorXd x = x_;
  x[probed_] += probe_;
  return x;
}

void ProbedNewton::update(const VectorXd &x, const VectorXd &residual) {
  const VectorXd moved = x - x_;
  slope_ += (residual - residual_ - slope_ * moved) * moved.transpose() / moved.squaredNorm();
}

void ProbedNewton::end() {
  has_probed_ = false;
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
