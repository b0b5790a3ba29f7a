#pragma once

#include <cstdint>
#include <optional>

namespace tourmaline::contact {

/// What crosses a contact besides forces.
enum class Crossing : std::uint8_t { heat, charge };

/// The state of a contact point at the end of a step, as what crosses there depends on it.
struct ContactState {
  double pressure = 0;     ///< p = -sigma_nu [N/m^2]
  double penetration = 0;  ///< u_nu - g - u_f.nu [m]
  double friction = 0;     ///< tau.d, the work of friction in the step [J/m^2], not negative
};

/// What leaves the body through a contact point, q.nu [W/m^2] or D.nu [C/m^2], by the temperature
/// theta [K] or the potential phi [V] at the point and its state, all at the end of the step. It
/// does not fall with theta or phi. What a linear exchange with a coefficient by place alone has in
/// it is in the operator, and not here.
class Exchange {
 public:
  virtual ~Exchange() = default;

  struct Value {
    double flow = 0;
    double by_value = 0;  ///< its derivatives: in theta or phi, >= 0,
    double by_pressure = 0, by_penetration = 0, by_friction = 0;  ///< and in the state
  };
  virtual Value at(double value, const ContactState &state) const = 0;
};

/// A conductance that fades as the gap opens, psi = clamp(1 + penetration/length, 0, 1); without a
/// length it is 1.
class Ramp {
 public:
  explicit Ramp(std::optional<double> length) : length_(length) {}

  double value(double penetration) const;
  double derivative(double penetration) const;  ///< [1/m]

 private:
  std::optional<double> length_;  // > 0 [m]
};

}  // namespace tourmaline::contact
