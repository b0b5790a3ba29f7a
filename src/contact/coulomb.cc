#include "contact/coulomb.h"

#include <fmt/format.h>

#include <cmath>

#include "contact/kinds.h"
#include "contact/values.h"
#include "printed_number.h"

namespace tourmaline::contact {

double FrictionCoefficient::value(double slip) const {
  return kinetic + (at_rest - kinetic) * std::exp(-(before + per_slip * slip) / scale);
}

double FrictionCoefficient::derivative(double slip) const {
  return -(at_rest - kinetic) * std::exp(-(before + per_slip * slip) / scale) * per_slip / scale;
}

FrictionBound::Value Coulomb::at(double pressure, double slip) const {
  const double mu = coefficient_.value(slip), free = cohesion_ + mu * pressure;
  if (free <= 0)
    return {};
  if (free >= limit_)
    return {limit_, 0, 0};
  return {free, mu, coefficient_.derivative(slip) * pressure};
}

namespace {

FrictionCoefficient coefficient_at(const casefile::FrictionCoefficientCase &asked,
                                   const Vector3 &point, double time, double step, double slipped) {
  FrictionCoefficient mu;
  if (asked.value) {
    mu.at_rest = mu.kinetic = not_negative(*asked.value, point, time, "the friction coefficient");
    return mu;
  }
  mu.at_rest = not_negative(*asked.at_rest, point, time, "the static friction coefficient");
  mu.kinetic = not_negative(*asked.kinetic, point, time, "the kinetic friction coefficient");
  if (asked.speed) {
    mu.scale = *asked.speed;
    mu.per_slip = 1 / step;
  } else {
    mu.scale = *asked.distance;
    mu.before = slipped;
    mu.per_slip = 1;
  }
  return mu;
}

std::shared_ptr<const FrictionBound> coulomb_bound(const casefile::FrictionCase &asked,
                                                   const Vector3 &point, double time, double step,
                                                   double slipped) {
  const double cohesion = not_negative(asked.cohesion, point, time, "the cohesion");
  const double limit = asked.limit
                           ? value_from(cohesion, *asked.limit, point, time,
                                        "the limit of the friction bound, beside the cohesion,")
                           : std::numeric_limits<double>::infinity();
  return std::make_shared<Coulomb>(coefficient_at(asked.coefficient, point, time, step, slipped),
                                   cohesion, limit);
}

std::string coefficient_words(const casefile::FrictionCoefficientCase &mu) {
  if (mu.value)
    return "μ = " + mu.value->text();
  return fmt::format(
      "μ from {} to {} over {}", mu.at_rest->text(), mu.kinetic->text(),
      mu.speed ? number_text(*mu.speed, 6) + " m/s" : number_text(*mu.distance, 6) + " m of slip");
}

std::string coulomb_words(const casefile::FrictionCase &asked) {
  std::string text = "Coulomb friction, " + coefficient_words(asked.coefficient);
  if (!asked.cohesion.is_zero())
    text += fmt::format(", cohesion {} N/m²", asked.cohesion.text());
  if (asked.limit)
    text += fmt::format(", at most {} N/m²", asked.limit->text());
  return text;
}

}  // namespace

const FrictionKind friction_kinds::coulomb{
    .name = "coulomb", .at = nullptr, .bound = coulomb_bound, .words = coulomb_words};

}  // namespace tourmaline::contact
