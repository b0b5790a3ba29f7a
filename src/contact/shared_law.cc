#include "contact/shared_law.h"

#include <memory>

namespace tourmaline::contact {

namespace {

class SharedLaw : public FrictionLaw {
 public:
  SharedLaw(std::shared_ptr<const FrictionLaw> whole, double share)
      : whole_(std::move(whole)), share_(share) {}

  double dissipation(const Tangent &d) const override { return share_ * whole_->dissipation(d); }
  Tangent traction(const Tangent &trial) const override {
    return share_ * whole_->traction(trial / share_);
  }
  TangentMatrix traction_derivative(const Tangent &trial) const override {
    return whole_->traction_derivative(trial / share_);
  }
  ContactStatus status(const Tangent &trial) const override {
    return whole_->status(trial / share_);
  }
  bool is_smooth_at(const Tangent &d) const override { return whole_->is_smooth_at(d); }
  Tangent gradient(const Tangent &d) const override { return share_ * whole_->gradient(d); }
  TangentMatrix hessian(const Tangent &d) const override { return share_ * whole_->hessian(d); }

 private:
  std::shared_ptr<const FrictionLaw> whole_;
  double share_;
};

}  // namespace

Friction shared(const Friction &law, double share) {
  if (const auto *ball = std::get_if<Tresca>(&law))
    return Tresca{share * ball->bound};
  return OwnLaw{std::make_shared<SharedLaw>(std::get<OwnLaw>(law).law, share)};
}

}  // namespace tourmaline::contact
