#include "contact/augmented_lagrangian.h"

namespace tourmaline::contact {

Tangent AugmentedLagrangian::tangential(const Local &components) const {
  return components.tail(components.size() - n_normal());
}

Tangent AugmentedLagrangian::trial(const Local &displacement, const Local &multiplier) const {
  return tangential(multiplier) + r_slip * tangential(displacement);
}

double AugmentedLagrangian::normal_trial(const Local &displacement, const Local &multiplier) const {
  return multiplier[0] + r_normal * displacement[0];
}

double AugmentedLagrangian::pressure(const Local &displacement, const Local &multiplier) const {
  const double trial = normal_trial(displacement, multiplier);
  return normal ? normal->pressure(trial, r_normal) : trial;
}

bool AugmentedLagrangian::is_closed(const Local &displacement, const Local &multiplier) const {
  return !normal || normal->is_closed(normal_trial(displacement, multiplier));
}

Tangent AugmentedLagrangian::friction_traction(const Local &displacement,
                                               const Local &multiplier) const {
  return friction.traction(trial(displacement, multiplier), r_slip);
}

AugmentedLagrangian::Gradient AugmentedLagrangian::gradient(const Local &displacement,
                                                            const Local &multiplier) const {
  const Eigen::Index n = multiplier.size(), n_slip = n - n_normal();
  Gradient g{Local::Zero(n), Local::Zero(n)};
  if (has_normal) {
    g.traction[0] = pressure(displacement, multiplier);
    g.condition[0] = normal ? (g.traction[0] - multiplier[0]) / r_normal : displacement[0];
    if (normal && is_held)
      g.condition[0] = 0;
  }
  const Tangent projected = friction_traction(displacement, multiplier);
  g.traction.tail(n_slip) = projected;
  if (!is_held)
    g.condition.tail(n_slip) = (projected - tangential(multiplier)) / r_slip;
  g.traction += spring * displacement;
  return g;
}

AugmentedLagrangian::Hessian AugmentedLagrangian::hessian(const Local &displacement,
                                                          const Local &multiplier) const {
  const Eigen::Index n = multiplier.size(), n_slip = n - n_normal();
  Hessian h{LocalMatrix::Zero(n, n), LocalMatrix::Zero(n, n), LocalMatrix::Zero(n, n)};
  if (has_normal) {
    const double slope =
        normal ? normal->pressure_derivative(normal_trial(displacement, multiplier), r_normal) : 1;
    const double known = normal && is_held ? 0 : slope;
    h.displacement(0, 0) = r_normal * slope;
    h.mixed(0, 0) = known;
    h.multiplier(0, 0) = (known - 1) / r_normal;
  }
  const TangentMatrix derivative =
      friction.traction_derivative(trial(displacement, multiplier), r_slip);
  const TangentMatrix known =
      is_held ? TangentMatrix(TangentMatrix::Zero(n_slip, n_slip)) : derivative;
  h.displacement.bottomRightCorner(n_slip, n_slip) = r_slip * derivative;
  h.mixed.bottomRightCorner(n_slip, n_slip) = known;
  h.multiplier.bottomRightCorner(n_slip, n_slip) =
      (known - TangentMatrix::Identity(n_slip, n_slip)) / r_slip;
  h.displacement.diagonal().array() += spring + lean;
  return h;
}

ContactStatus AugmentedLagrangian::status(const Local &displacement,
                                          const Local &multiplier) const {
  return friction.status(trial(displacement, multiplier), r_slip);
}

}  // namespace tourmaline::contact
