#pragma once

namespace tourmaline::contact {

/// What the foundation answers along the normal at one contact point in one step: the pressure p =
/// -sigma_nu [N/m^2] to the penetration delta = u_nu - g - u_f.nu [m], which is negative where a
/// gap is open. The relation is maximal monotone, the subdifferential of a convex potential, and
/// has no pressure where delta < 0 unless the contact is bilateral.
class NormalLaw {
 public:
  virtual ~NormalLaw() = default;

  /// The resolvent: p for the trial value y = p + r delta, r > 0 [N/m^3]; and its derivative in y,
  /// from 0 to 1.
  virtual double pressure(double trial, double r) const = 0;
  virtual double pressure_derivative(double trial, double r) const = 0;

  /// Whether p is a function of delta there, differentiable at least from one side; it follows,
  /// with its derivative [N/m^3].
  virtual bool is_smooth_at(double delta) const = 0;
  virtual double pressure_at(double delta) const = 0;
  virtual double stiffness_at(double delta) const = 0;
  /// Whether the relation has a vertical part, which then stands at delta = 0.
  virtual bool has_kink() const = 0;

  /// The potential of p [J/m^2], infinite where the body cannot be. Of the work done on the
  /// foundation, what it holds then and gives back; and what it has dissipated in this step.
  virtual double potential(double delta) const = 0;
  virtual double stored(double /*delta*/) const { return 0; }
  virtual double dissipated(double /*delta*/) const { return 0; }

  /// Whether the trial value is that of a point that touches.
  virtual bool is_closed(double trial) const { return trial >= 0; }
};

}  // namespace tourmaline::contact
