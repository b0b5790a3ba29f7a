#include "solve/slip_descent.h"

#include <algorithm>
#include <cmath>

#include "larger.h"
#include "solve/stall.h"
#include "solve/truncation.h"

namespace tourmaline::solve {

namespace {

using contact::Tangent;
using contact::TangentMatrix;
using Eigen::VectorXd;

class Descent {
 public:
  Descent(const SlipProgramme &programme, SlipResponse &response, VectorXd start)
      : programme_(programme),
        points_(programme.points),
        response_(response),
        d_(std::move(start)),
        force_(response.force(d_)) {}

  double allowed(double tolerance) const { return tolerance * response_.force_size(); }
  double largest_residual() const;
  /// True when something moved.
  bool proximal_step(double tolerance);
  /// Solves one linear system; true when points came to stick on the way, so that the step after it
  /// is another one.
  bool newton_step(double tolerance);
  /// Puts points that stick, but for round-off, at exactly zero. True when there were some.
  bool settle();
  InterfaceSolution solution(double allowed) const;

 private:
  Tangent part(const VectorXd &v, std::size_t i) const {
    return v.segment(points_[i].offset, points_[i].size);
  }
  Tangent trial(std::size_t i, double r) const { return part(force_, i) + r * points_[i].slip(d_); }
  Tangent friction_force(std::size_t i, double r) const;
  double residual(std::size_t i) const {
    return (part(force_, i) - friction_force(i, programme_.curvature[i])).norm();
  }
  VectorXd proximal_point(double tolerance) const;
  std::vector<bool> smooth_points() const;
  double dissipation(const VectorXd &d) const;
  VectorXd along(const VectorXd &direction, double length) const;
  double length_of_descent(const VectorXd &direction, const VectorXd &resisted) const;
  VectorXd newton_direction(const std::vector<bool> &is_smooth);
  bool descends(const VectorXd &next, const VectorXd &next_force, double tolerance) const;
  bool accept(const VectorXd &next, double tolerance);
  bool restore();

  const SlipProgramme &programme_;
  const std::vector<ContactPoint> &points_;
  SlipResponse &response_;
  VectorXd d_;                     // slip increments
  VectorXd force_;                 // f - A d
  double stiffness_factor_ = 0.5;  // of the curvatures, with which the last proximal step descended
};

Tangent Descent::friction_force(std::size_t i, double r) const {
  const ContactPoint &p = points_[i];
  return p.weight * p.law.traction(trial(i, r) / p.weight, r / p.weight);
}

double Descent::largest_residual() const {
  double largest = 0;
  for (std::size_t i = 0; i < points_.size(); ++i)
    largest = larger(largest, residual(i));
  return largest;
}

// Every point's own problem with A replaced by a multiple of the identity. A point inside the ball
// comes out as exactly zero, and so does one at its surface, which round-off would make slip: by so
// little that no linear step holds, and each stops at its kink.
VectorXd Descent::proximal_point(double tolerance) const {
  const double nothing = 1e-3 * allowed(tolerance);
  VectorXd next = d_;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const double r = stiffness_factor_ * programme_.curvature[i];
    const Tangent resisted = trial(i, r) - friction_force(i, r);
    const ContactPoint &p = points_[i];
    if (resisted.norm() <= nothing)
      p.hold(next);
    else
      p.put(resisted / r, next);
  }
  return next;
}

// The value of the programme falls by half of |change|^2, measured with the replaced A, as long as
// A resists the change less than that does. A change that is too stiff is tried with a stiffer one.
bool Descent::proximal_step(double tolerance) {
  constexpr int most_tries = 40;  // a factor of 2^40 in the stiffness
  for (int k = 0; k < most_tries; ++k) {
    const VectorXd next = proximal_point(tolerance);
    const VectorXd change = next - d_;
    if (change.isZero(0))
      return restore();
    double assumed = 0;
    for (std::size_t i = 0; i < points_.size(); ++i)
      assumed += stiffness_factor_ * programme_.curvature[i] * part(change, i).squaredNorm();
    const VectorXd next_force = response_.force(next);
    const double resisted = change.dot(force_ - next_force);
    const double round_off = allowed(tolerance) * change.lpNorm<1>();
    if (resisted <= assumed + round_off) {
      d_ = next;
      force_ = next_force;
      stiffness_factor_ *= std::clamp(1.1 * resisted / assumed, 0.5, 1.);
      return true;
    }
    stiffness_factor_ *= std::max(2., 1.1 * resisted / assumed);
  }
  return restore();
}

std::vector<bool> Descent::smooth_points() const {
  std::vector<bool> smooth;
  for (std::size_t i = 0; i < points_.size(); ++i)
    smooth.push_back(points_[i].size > 0 && points_[i].law.is_smooth_at(points_[i].slip(d_)));
  return smooth;
}

double Descent::dissipation(const VectorXd &d) const {
  double sum = 0;
  for (std::size_t i = 0; i < points_.size(); ++i)
    sum += points_[i].weight * points_[i].law.potential(points_[i].slip(d));
  return sum;
}

// On the straight line: where it leads through zero, the point is there exactly.
VectorXd Descent::along(const VectorXd &direction, double length) const {
  VectorXd next = d_ + length * direction;
  for (std::size_t i = 0; i < points_.size(); ++i)
    if (points_[i].slip(next).norm() <= 1e-6 * points_[i].slip(d_).norm())
      points_[i].hold(next);
  return next;
}

// Where the value is least between 0 and 1. It is convex, so nested intervals find it; where it has
// its kinks and bends is known better than they can tell.
double Descent::length_of_descent(const VectorXd &direction, const VectorXd &resisted) const {
  const double work = force_.dot(direction), stiffness = direction.dot(resisted);
  const auto value = [&](double t) {
    return t * (t * stiffness / 2 - work) + dissipation(along(direction, t));
  };
  constexpr double golden = 0.6180339887498949;
  double low = 0, high = 1;
  for (int k = 0; k < 40; ++k) {
    const double a = high - golden * (high - low), b = low + golden * (high - low);
    (value(a) <= value(b) ? high : low) = value(a) <= value(b) ? b : a;
  }
  const double middle = (low + high) / 2;
  double best = middle, below = 0, above = 1;
  for (const ContactPoint &p : points_) {
    const double turn = length_to_turn(p, d_, direction, Turns::kinks_and_bends);
    if (turn <= middle)
      below = std::max(below, turn);
    else
      above = std::min(above, turn);
  }
  for (const double t : {below, above})
    if (value(t) <= value(best))
      best = t;
  return best;
}

VectorXd Descent::newton_direction(const std::vector<bool> &is_smooth) {
  std::vector<TangentMatrix> hessian(points_.size());
  VectorXd descent = VectorXd::Zero(d_.size());
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (!is_smooth[i])
      continue;
    const ContactPoint &p = points_[i];
    const Tangent d = p.slip(d_);
    hessian[i] = p.weight * p.law.hessian(d);
    descent.segment(p.offset, p.size) = part(force_, i) - p.weight * p.law.gradient(d);
  }
  const VectorXd direction = response_.direction(is_smooth, hessian, descent);
  // An inexact one may lead nowhere.
  return direction.size() == 0 || direction.dot(descent) <= 0 ? VectorXd() : direction;
}

// The change of the quadratic part is that of the mean force, exactly.
bool Descent::descends(const VectorXd &next, const VectorXd &next_force, double tolerance) const {
  const VectorXd change = next - d_;
  const double work = (force_ + next_force).dot(change) / 2, dissipated = dissipation(d_);
  const double round_off =
      1e-14 * (std::abs(force_.dot(change)) + dissipated) + allowed(tolerance) * change.lpNorm<1>();
  return dissipation(next) - dissipated - work <= round_off;
}

bool Descent::accept(const VectorXd &next, double tolerance) {
  const VectorXd next_force = response_.force(next);
  if (!descends(next, next_force, tolerance))
    return false;
  d_ = next;
  force_ = next_force;
  return true;
}

// A step that was refused: the body goes back to where the increments are.
bool Descent::restore() {
  force_ = response_.force(d_);
  return false;
}

bool Descent::newton_step(double tolerance) {
  const std::vector<bool> smooth = smooth_points();
  const auto n_smooth = std::count(smooth.begin(), smooth.end(), true);
  if (n_smooth == 0)
    return false;
  const VectorXd direction = newton_direction(smooth);
  if (direction.size() == 0)
    return restore();
  if (!accept(truncated_step(points_, d_, direction, 1, Turns::kinks), tolerance)) {
    const VectorXd resisted = force_ - response_.force(d_ + direction);
    if (!accept(along(direction, length_of_descent(direction, resisted)), tolerance))
      return restore();
  }
  const std::vector<bool> after = smooth_points();
  return std::count(after.begin(), after.end(), true) < n_smooth;
}

bool Descent::settle() {
  VectorXd next = d_;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const ContactPoint &p = points_[i];
    const double r = programme_.curvature[i];
    if (p.size > 0 && p.law.has_kink(p.size) &&
        p.law.status(trial(i, r) / p.weight, r / p.weight) == ContactStatus::stick)
      p.hold(next);
  }
  if (next == d_)
    return false;
  d_ = next;
  force_ = response_.force(d_);
  return true;
}

InterfaceSolution Descent::solution(double allowed) const {
  InterfaceSolution solution;
  solution.increment = d_;
  solution.force = VectorXd::Zero(d_.size());
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const ContactPoint &p = points_[i];
    const double r = programme_.curvature[i];
    solution.force.segment(p.offset, p.size) = friction_force(i, r);
    solution.status.push_back(p.law.status(trial(i, r) / p.weight, r / p.weight));
    if (!(residual(i) <= allowed))
      solution.unsettled.push_back(i);
  }
  solution.residual = largest_residual() / response_.force_size();
  solution.converged = solution.unsettled.empty();
  return solution;
}

}  // namespace

InterfaceSolution minimise(const SlipProgramme &programme, SlipResponse &response, VectorXd start,
                           const InterfaceSettings &settings) {
  constexpr int patience = 3;
  Descent descent(programme, response, std::move(start));
  int solved = 0, last_gain = 0;
  double allowed = 0;
  const auto residual = [&] {
    allowed = descent.allowed(settings.tolerance);
    const bool is_small =
        descent.largest_residual() <= std::max(allowed, response.force_accuracy());
    if (is_small)
      descent.settle();
    return descent.largest_residual();
  };
  double least = residual();
  Creep creep(settings.patience);
  while (least > allowed && solved < settings.max_iterations && !creep.see(least) &&
         (least > response.force_accuracy() || solved - last_gain < patience)) {
    descent.proximal_step(settings.tolerance);
    bool more = true;
    while (more && solved < settings.max_iterations) {
      more = descent.newton_step(settings.tolerance);
      ++solved;
    }
    if (const double now = residual(); now < least) {
      least = now;
      last_gain = solved;
    }
  }
  InterfaceSolution solution = descent.solution(std::max(allowed, response.force_accuracy()));
  solution.iterations = solved;
  return solution;
}

}  // namespace tourmaline::solve
