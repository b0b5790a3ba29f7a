#pragma once

#include <concepts>
#include <memory>
#include <variant>

#include "contact/normal_law.h"
#include "contact/point_law.h"

namespace tourmaline::contact {

/// A normal law as a law of one component, delta.
class NormalPoint {
 public:
  explicit NormalPoint(std::shared_ptr<const NormalLaw> law) : law_(std::move(law)) {}

  double dissipation(const Tangent &delta) const { return law_->potential(delta[0]); }
  Tangent traction(const Tangent &trial, double r) const;
  TangentMatrix traction_derivative(const Tangent &trial, double r) const;
  ContactStatus status(const Tangent &trial, double r) const;
  bool is_smooth_at(const Tangent &delta) const { return law_->is_smooth_at(delta[0]); }
  Tangent gradient(const Tangent &delta) const;
  TangentMatrix hessian(const Tangent &delta) const;
  bool has_kink(Eigen::Index /*n_free*/) const { return law_->has_kink(); }
  bool has_bend(Eigen::Index /*n_free*/) const { return false; }
  Tangent held() const { return Tangent(0); }

  const NormalLaw &law() const { return *law_; }
  NormalPoint behind_spring(double stiffness) const;

 private:
  std::shared_ptr<const NormalLaw> law_;
};

/// A contact law as the contact iteration sees it: convex in its own components, of the slip
/// increment or along the normal, with all that it takes from elsewhere held. The functions are
/// those of `PointLaw`.
class LocalLaw {
 private:
  template <class Function>
  auto with_law(Function &&f) const {
    return std::visit(std::forward<Function>(f), law_);
  }

 public:
  LocalLaw() = default;
  LocalLaw(NormalPoint law) : law_(std::move(law)) {}
  LocalLaw(PointLaw law) : law_(std::move(law)) {}
  template <std::convertible_to<Friction> Law>
  LocalLaw(Law law) : law_(PointLaw(std::move(law))) {}

  /// Of a friction law; there must be one.
  const PointLaw &friction() const { return std::get<PointLaw>(law_); }
  PointLaw &friction() { return std::get<PointLaw>(law_); }
  /// Nothing for a friction law.
  const NormalLaw *normal() const;

  /// A normal law with a spring of that stiffness [N/m^3] before it; a friction law as it is.
  LocalLaw behind_spring(double stiffness) const;

  /// The potential: of friction the dissipation, along the normal that of the pressure [J/m^2].
  double potential(const Tangent &d) const {
    return with_law([&](const auto &law) { return law.dissipation(d); });
  }
  Tangent traction(const Tangent &trial, double r) const {
    return with_law([&](const auto &law) { return law.traction(trial, r); });
  }
  TangentMatrix traction_derivative(const Tangent &trial, double r) const {
    return with_law([&](const auto &law) { return law.traction_derivative(trial, r); });
  }
  ContactStatus status(const Tangent &trial, double r) const {
    return with_law([&](const auto &law) { return law.status(trial, r); });
  }
  bool is_smooth_at(const Tangent &d) const {
    return with_law([&](const auto &law) { return law.is_smooth_at(d); });
  }
  Tangent gradient(const Tangent &d) const {
    return with_law([&](const auto &law) { return law.gradient(d); });
  }
  TangentMatrix hessian(const Tangent &d) const {
    return with_law([&](const auto &law) { return law.hessian(d); });
  }
  bool has_kink(Eigen::Index n_free) const {
    return with_law([&](const auto &law) { return law.has_kink(n_free); });
  }
  bool has_bend(Eigen::Index n_free) const {
    return with_law([&](const auto &law) { return law.has_bend(n_free); });
  }
  Tangent held() const {
    return with_law([](const auto &law) { return Tangent(law.held()); });
  }

 private:
  std::variant<PointLaw, NormalPoint> law_;
};

}  // namespace tourmaline::contact
