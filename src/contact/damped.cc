#include "contact/damped.h"

#include <fmt/format.h>

#include "contact/kinds.h"
#include "contact/values.h"

namespace tourmaline::contact {

double Damped::pressure(double trial, double r) const {
  return layer_.pressure(trial - r * before_, r);
}

double Damped::pressure_derivative(double trial, double r) const {
  return layer_.pressure_derivative(trial - r * before_, r);
}

double Damped::pressure_at(double delta) const {
  return layer_.pressure_at(delta - before_);
}

double Damped::stiffness_at(double delta) const {
  return layer_.stiffness_at(delta - before_);
}

double Damped::potential(double delta) const {
  return layer_.potential(delta - before_);
}

double Damped::dissipated(double delta) const {
  return pressure_at(delta) * (delta - before_);
}

namespace {

std::string damped_words(const casefile::NormalCase &asked) {
  return fmt::format("damped contact, c = {} N s/m³", text_of(asked.coefficient));
}

std::shared_ptr<const NormalLaw> damped_at(const casefile::NormalCase &asked, const Vector3 &point,
                                           double step, double before) {
  return std::make_shared<Damped>(
      positive(asked.coefficient, point, "the coefficient of the damped response"), step, before);
}

}  // namespace

const NormalKind normal_kinds::damped{.name = "damped", .at = damped_at, .words = damped_words};

}  // namespace tourmaline::contact
