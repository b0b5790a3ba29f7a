#include "contact/point_law.h"

#include <cmath>
#include <utility>

namespace tourmaline::contact {

using Eigen::Index;

namespace {

// Of the law's answers to the slip d, where J is not smooth, the nearest to `borne`: ascent of
// lambda.d on the law's set from there, by steps of r, ends at the face that d belongs to.
Tangent nearest_answer(const FrictionLaw &law, const Tangent &d, double r, const Tangent &borne) {
  constexpr int most = 100;
  Tangent lambda = law.traction(borne);
  for (int k = 0; k < most; ++k) {
    const Tangent next = law.traction(lambda + r * d);
    if (next == lambda)
      break;
    lambda = next;
  }
  return lambda;
}

}  // namespace

Tangent PointLaw::whole(const Tangent &free, const Tangent &known) const {
  Tangent all(free.size() + known.size());
  all << free, known;
  return all;
}

// With one free and one known component the law's whole answer is P(x, y), where y, the trial value
// along the known direction, is such that the slip there is o:
//
//     g(y) = y - P_2(x, y) - r o = 0.
//
// As P is a projection, g grows and its slope is at most 1. It has an interval of zeros where the
// point is held at rest (o = 0): taken is the nearest to `start`. Newton's method within a bracket.
double PointLaw::known_trial(const Tangent &trial, double r, double start) const {
  const auto at = [&](double y) { return whole(trial, Tangent::Constant(1, y)); };
  const auto lack = [&](double y) { return y - rule().traction(at(y))[1] - r * held_[0]; };
  double g = lack(start);
  if (g == 0)
    return start;
  const double sense = g > 0 ? -1 : 1;
  double near = start, far = start + 2 * sense * std::abs(g);
  for (double gap = lack(far); gap * sense < 0 && std::isfinite(far); gap = lack(far)) {
    near = std::exchange(far, far + 2 * (far - near));
    g = gap;
  }
  constexpr int more_than_bisection_needs = 200;
  for (int k = 0; k < more_than_bisection_needs; ++k) {
    const double slope = 1 - rule().traction_derivative(at(near))(1, 1);
    double next = near - g / slope;
    if (!((next - near) * sense > 0 && (far - next) * sense > 0))
      next = near + (far - near) / 2;
    if (next == near || next == far)
      break;
    if (const double gap = lack(next); gap * sense < 0) {
      near = next;
      g = gap;
    } else {
      far = next;
    }
  }
  return far;
}

Tangent PointLaw::whole_trial(const Tangent &trial, double r) const {
  if (held_.size() == 0)
    return trial;
  return whole(trial, Tangent::Constant(1, known_trial(trial, r, r * held_[0])));
}

double PointLaw::dissipation(const Tangent &slip) const {
  return rule().dissipation(whole(slip, held_));
}

Tangent PointLaw::traction(const Tangent &trial, double r) const {
  if (trial.size() == 0)
    return trial;
  const Tangent x = whole_trial(trial, r);
  return rule().traction(x).head(trial.size());
}

// With P' of the whole law, the known trial value moves so that the slip there stays o:
// (1 - P'_22) dy = P'_21 dx. Where P'_22 = 1 nothing couples the two, as P' <= 1.
TangentMatrix PointLaw::traction_derivative(const Tangent &trial, double r) const {
  const Index n = trial.size();
  if (n == 0)
    return TangentMatrix(0, 0);
  const Tangent x = whole_trial(trial, r);
  TangentMatrix whole = rule().traction_derivative(x);
  if (held_.size() == 0)
    return whole;
  const double left = 1 - whole(1, 1), across = whole(0, 1) * whole(1, 0);
  return TangentMatrix::Constant(1, 1, whole(0, 0) + (left > 0 ? across / left : 0));
}

ContactStatus PointLaw::status(const Tangent &trial, double r) const {
  if (!held_.isZero(0))
    return ContactStatus::slip;
  if (held_.size() == 0)
    return rule().status(trial);
  // The known trial value of a point that sticks lies on the border of the law's set, where the law
  // itself may say either.
  const bool slips = (trial - traction(trial, r)).norm() > 1e-14 * trial.norm();
  return slips ? ContactStatus::slip : ContactStatus::stick;
}

Tangent PointLaw::whole_traction(const Tangent &slip, const Tangent &free,
                                 const Tangent &borne) const {
  return whole(free, known_traction(slip, free, borne));
}

Tangent PointLaw::known_traction(const Tangent &slip, const Tangent &free,
                                 const Tangent &borne) const {
  const Tangent d = whole(slip, held_);
  if (held_.size() == 0)
    return held_;
  const FrictionLaw &law = rule();
  if (law.is_smooth_at(d))
    return law.gradient(d).tail(held_.size());
  const double r = d.isZero(0) ? 1 : law.dissipation(d) / d.squaredNorm();
  if (free.size() == 0)
    return nearest_answer(law, d, r, borne);
  const Tangent trial = free + r * slip;
  const double y = known_trial(trial, r, borne[0] + r * held_[0]);
  return law.traction(whole(trial, Tangent::Constant(1, y))).tail(1);
}

bool PointLaw::is_smooth_at(const Tangent &slip) const {
  return rule().is_smooth_at(whole(slip, held_));
}

Tangent PointLaw::gradient(const Tangent &slip) const {
  return rule().gradient(whole(slip, held_)).head(slip.size());
}

// With one free component the Hessian is the small difference of large terms where o is small
// beside z; what round-off makes negative would take the convexity away.
TangentMatrix PointLaw::hessian(const Tangent &slip) const {
  const TangentMatrix part =
      rule().hessian(whole(slip, held_)).topLeftCorner(slip.size(), slip.size());
  return held_.size() == 0 ? part : TangentMatrix(part.cwiseMax(0));
}

bool PointLaw::has_kink(Index n_free) const {
  return !is_smooth_at(Tangent::Zero(n_free));
}

bool PointLaw::has_bend(Index n_free) const {
  return !held_.isZero(0) && !has_kink(n_free) &&
         !rule().is_smooth_at(Tangent::Zero(n_free + held_.size()));
}

std::optional<double> PointLaw::bound() const {
  const auto *ball = std::get_if<Tresca>(&law_);
  return ball ? std::optional(ball->bound) : std::nullopt;
}

}  // namespace tourmaline::contact
