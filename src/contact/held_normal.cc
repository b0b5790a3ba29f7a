#include "contact/held_normal.h"

#include <limits>

#include "contact/kinds.h"

namespace tourmaline::contact {

double HeldNormal::pressure(double trial, double /*r*/) const {
  return trial;
}

double HeldNormal::pressure_derivative(double /*trial*/, double /*r*/) const {
  return 1;
}

bool HeldNormal::is_smooth_at(double /*delta*/) const {
  return false;
}

double HeldNormal::pressure_at(double /*delta*/) const {
  return 0;
}

double HeldNormal::stiffness_at(double /*delta*/) const {
  return 0;
}

double HeldNormal::potential(double delta) const {
  return delta == 0 ? 0 : std::numeric_limits<double>::infinity();
}

bool HeldNormal::is_closed(double /*trial*/) const {
  return true;
}

const NormalKind normal_kinds::bilateral{
    .name = "bilateral",
    .at = [](const casefile::NormalCase &, const Vector3 &, double,
             double) -> std::shared_ptr<const NormalLaw> { return std::make_shared<HeldNormal>(); },
    .words = [](const casefile::NormalCase &) -> std::string { return "bilateral contact"; }};

}  // namespace tourmaline::contact
