#include "contact/local_law.h"

#include "contact/yosida_normal.h"

namespace tourmaline::contact {

Tangent NormalPoint::traction(const Tangent &trial, double r) const {
  return Tangent::Constant(1, law_->pressure(trial[0], r));
}

TangentMatrix NormalPoint::traction_derivative(const Tangent &trial, double r) const {
  return TangentMatrix::Constant(1, 1, law_->pressure_derivative(trial[0], r));
}

ContactStatus NormalPoint::status(const Tangent &trial, double /*r*/) const {
  return law_->is_closed(trial[0]) ? ContactStatus::stick : ContactStatus::open;
}

Tangent NormalPoint::gradient(const Tangent &delta) const {
  return Tangent::Constant(1, law_->pressure_at(delta[0]));
}

TangentMatrix NormalPoint::hessian(const Tangent &delta) const {
  return TangentMatrix::Constant(1, 1, law_->stiffness_at(delta[0]));
}

NormalPoint NormalPoint::behind_spring(double stiffness) const {
  return NormalPoint(std::make_shared<YosidaNormal>(law_, stiffness));
}

LocalLaw LocalLaw::behind_spring(double stiffness) const {
  const auto *point = std::get_if<NormalPoint>(&law_);
  return point == nullptr ? *this : LocalLaw(point->behind_spring(stiffness));
}

const NormalLaw *LocalLaw::normal() const {
  const auto *point = std::get_if<NormalPoint>(&law_);
  return point == nullptr ? nullptr : &point->law();
}

}  // namespace tourmaline::contact
