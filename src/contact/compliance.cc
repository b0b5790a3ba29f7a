#include "contact/compliance.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "contact/kinds.h"
#include "contact/values.h"

namespace tourmaline::contact {

// The root of c delta^m + r delta = y > 0. The left side is convex and grows, so Newton's method
// from above comes down to it.
double Compliance::penetration(double trial, double r) const {
  if (exponent_ == 1)
    return trial / (coefficient_ + r);
  double delta = std::min(trial / r, std::pow(trial / coefficient_, 1 / exponent_));
  constexpr int more_than_needed = 100;
  for (int k = 0; k < more_than_needed; ++k) {
    const double next =
        delta - (pressure_at(delta) + r * delta - trial) / (stiffness_at(delta) + r);
    if (!(next < delta))
      break;
    delta = next;
  }
  return delta;
}

double Compliance::pressure(double trial, double r) const {
  if (trial <= 0)
    return 0;
  const double delta = penetration(trial, r);
  // The smaller of the two terms has the more digits.
  const double borne = pressure_at(delta);
  return borne < trial / 2 ? borne : trial - r * delta;
}

// Where the body just touches, the slope is that of pressing it in: a body that only the contact
// holds would be loose at the start otherwise.
double Compliance::pressure_derivative(double trial, double r) const {
  if (trial < 0)
    return 0;
  const double stiffness = stiffness_at(penetration(trial, r));
  return stiffness / (stiffness + r);
}

double Compliance::pressure_at(double delta) const {
  return delta > 0 ? coefficient_ * std::pow(delta, exponent_) : 0;
}

double Compliance::stiffness_at(double delta) const {
  return delta >= 0 ? coefficient_ * exponent_ * std::pow(delta, exponent_ - 1) : 0;
}

double Compliance::potential(double delta) const {
  return delta > 0 ? coefficient_ * std::pow(delta, exponent_ + 1) / (exponent_ + 1) : 0;
}

namespace {

std::string compliance_words(const casefile::NormalCase &asked) {
  const std::string c = text_of(asked.coefficient);
  if (asked.exponent == 1)
    return fmt::format("compliance, p = c (u_ν − g)₊, c = {} N/m³", c);
  return fmt::format("compliance, p = c (u_ν − g)₊^{}, c = {} N/m^{}", asked.exponent, c,
                     2 + asked.exponent);
}

std::shared_ptr<const NormalLaw> compliance_at(const casefile::NormalCase &asked,
                                               const Vector3 &point, double /*step*/,
                                               double /*before*/) {
  return std::make_shared<Compliance>(
      positive(asked.coefficient, point, "the coefficient of normal compliance"), asked.exponent);
}

}  // namespace

const NormalKind normal_kinds::compliance{
    .name = "compliance", .at = compliance_at, .words = compliance_words};

}  // namespace tourmaline::contact
