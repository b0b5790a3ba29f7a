#pragma once

#include <Eigen/Dense>
#include <cmath>

#include "tourmaline/contact/friction_law.h"

namespace tourmaline::verified {

/// Somebody's law in space, with more friction along one line of the foundation than across it:
/// lambda in the ellipse lambda.shape^-1 lambda <= 1, shape [N^2/m^4].
class Ellipse : public contact::FrictionLaw {
 public:
  explicit Ellipse(const Eigen::Matrix2d &shape) : shape_(shape) {}

  double dissipation(const contact::Tangent &d) const override {
    return std::sqrt(d.dot(shape_ * d));
  }
  // The nearest point solves (1 + t M) p = x with p.M p = 1, M the inverse of the shape.
  contact::Tangent traction(const contact::Tangent &x) const override {
    return outside(x) ? contact::Tangent(factors(x).solve(x)) : x;
  }
  contact::TangentMatrix traction_derivative(const contact::Tangent &x) const override {
    contact::TangentMatrix derivative = contact::TangentMatrix::Identity(2, 2);
    if (!outside(x))
      return derivative;
    const auto f = factors(x);
    const contact::Tangent normal = shape_.inverse() * traction(x), turned = f.solve(normal);
    derivative = f.inverse();
    return derivative - turned * turned.transpose() / normal.dot(turned);
  }
  ContactStatus status(const contact::Tangent &x) const override {
    return outside(x) ? ContactStatus::slip : ContactStatus::stick;
  }
  bool is_smooth_at(const contact::Tangent &d) const override { return !d.isZero(0); }
  contact::Tangent gradient(const contact::Tangent &d) const override {
    return shape_ * d / dissipation(d);
  }
  contact::TangentMatrix hessian(const contact::Tangent &d) const override {
    const contact::Tangent g = gradient(d);
    return (shape_ - g * g.transpose()) / dissipation(d);
  }

 private:
  bool outside(const contact::Tangent &x) const { return x.dot(shape_.inverse() * x) > 1; }
  Eigen::LDLT<Eigen::Matrix2d> factors_at(double t) const {
    return Eigen::LDLT<Eigen::Matrix2d>(Eigen::Matrix2d::Identity() + t * shape_.inverse());
  }
  Eigen::FullPivLU<Eigen::Matrix2d> factors(const contact::Tangent &x) const {
    double low = 0, high = 1;
    const auto beyond = [&](double t) {
      const Eigen::Vector2d p = factors_at(t).solve(x);
      return p.dot(shape_.inverse() * p) > 1;
    };
    while (beyond(high))
      high *= 2;
    for (int k = 0; k < 200; ++k)
      (beyond((low + high) / 2) ? low : high) = (low + high) / 2;
    return Eigen::FullPivLU<Eigen::Matrix2d>(Eigen::Matrix2d::Identity() + high * shape_.inverse());
  }

  Eigen::Matrix2d shape_;
};

}  // namespace tourmaline::verified
