#pragma once

#include <Eigen/Dense>
#include <memory>

#include "contact/normal_law.h"
#include "contact/point_law.h"

namespace tourmaline::contact {

/// Components at a contact point: along the normal, where the point has a normal multiplier, then
/// along the tangential directions. At most three.
using Local = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3, 1>;
using LocalMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 3, 3>;

/// The augmented Lagrangian l_nu + l_tau (40), (41) per area at one contact point, in the
/// displacement y = (u_nu, d), d = du_tau the slip increment over the step, and the multiplier
/// lambda = (lambda_nu, lambda_tau) = -sigma nu:
///
///     l_nu = u_nu lambda_nu + r_nu / 2 u_nu^2       where contact is bilateral,
///     l_nu = (R-envelope) with dl_nu/du_nu = p(lambda_nu + r_nu u_nu)   of another normal law,
///     l_tau = d.lambda_tau + r / 2 |d|^2 - dist^2(lambda_tau + r d, C[S]) / (2 r),  r = r_tau / k
///
/// Paper (41) has the velocity d / k in the place of d: r_tau (d / k) = r d, so the projected
/// traction is the same, and l_tau is k times the paper's. That makes its gradient in d the
/// traction which (42) pairs with v, and its Hessian symmetric. The gradient is the contact
/// operator F (42), the Hessian the contact tangent T (43), both by the law's own projection and
/// derivative.
struct AugmentedLagrangian {
  bool has_normal = true;
  double r_normal = 0;                      ///< r_nu > 0 [N/m^3]
  double r_slip = 0;                        ///< r = r_tau / k > 0 [N/m^3]
  std::shared_ptr<const NormalLaw> normal;  ///< nothing: bilateral
  PointLaw friction;
  /// The multipliers of friction, and of a normal law that is not bilateral, are parameters, not
  /// unknowns: l as a function of y alone, convex and smooth to first order. Their conditions are
  /// then 0 and leave the multipliers where they are.
  bool is_held = false;
  /// Springs to the foundation: spring / 2 |y|^2 as a means to find a start, and what the Hessian
  /// alone has of one, where without it a tangent may be singular [N/m^3].
  double spring = 0, lean = 0;

  struct Gradient {
    Local traction;  ///< in y: (p(lambda_nu + r_nu u_nu), P(lambda_tau + r d)) [N/m^2]
    /// in lambda: ((p - lambda_nu) / r_nu, (P(lambda_tau + r d) - lambda_tau) / r) [m], the first
    /// u_nu where contact is bilateral
    Local condition;
  };
  Gradient gradient(const Local &displacement, const Local &multiplier) const;

  /// Symmetric as a whole, because P is the derivative of a convex function. At the kink the law's
  /// choice holds.
  struct Hessian {
    LocalMatrix displacement;  ///< yy: diag(r_nu p', r P')
    LocalMatrix mixed;         ///< y lambda: diag(p', P')
    LocalMatrix multiplier;    ///< lambda lambda: diag((p' - 1) / r_nu, (P' - I) / r)
  };
  Hessian hessian(const Local &displacement, const Local &multiplier) const;

  ContactStatus status(const Local &displacement, const Local &multiplier) const;

  /// p(lambda_nu + r_nu u_nu), where the point has a normal multiplier [N/m^2]; and whether that
  /// is the pressure of a point that touches.
  double pressure(const Local &displacement, const Local &multiplier) const;
  bool is_closed(const Local &displacement, const Local &multiplier) const;
  /// lambda_nu + r_nu u_nu, of a point that has a normal multiplier [N/m^2].
  double normal_trial(const Local &displacement, const Local &multiplier) const;
  /// P(lambda_tau + r d) [N/m^2].
  Tangent friction_traction(const Local &displacement, const Local &multiplier) const;

 private:
  Eigen::Index n_normal() const { return has_normal ? 1 : 0; }
  Tangent tangential(const Local &components) const;
  Tangent trial(const Local &displacement, const Local &multiplier) const;
};

}  // namespace tourmaline::contact
