#include "contact/unilateral.h"

#include <algorithm>
#include <limits>

#include "contact/kinds.h"

namespace tourmaline::contact {

double Unilateral::pressure(double trial, double /*r*/) const {
  return std::max(0., trial);
}

double Unilateral::pressure_derivative(double trial, double /*r*/) const {
  return trial >= 0 ? 1 : 0;
}

bool Unilateral::is_smooth_at(double delta) const {
  return delta < 0;
}

double Unilateral::pressure_at(double /*delta*/) const {
  return 0;
}

double Unilateral::stiffness_at(double /*delta*/) const {
  return 0;
}

double Unilateral::potential(double delta) const {
  return delta <= 0 ? 0 : std::numeric_limits<double>::infinity();
}

const NormalKind normal_kinds::unilateral{
    .name = "unilateral",
    .at = [](const casefile::NormalCase &, const Vector3 &, double,
             double) -> std::shared_ptr<const NormalLaw> { return std::make_shared<Unilateral>(); },
    .words = [](const casefile::NormalCase &) -> std::string { return "unilateral contact"; }};

}  // namespace tourmaline::contact
