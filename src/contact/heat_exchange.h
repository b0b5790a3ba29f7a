#pragma once

#include "contact/exchange.h"

namespace tourmaline::contact {

/// A conductance that grows with the pressure, h = coefficient (p/reference)^exponent where p > 0.
struct PressureConductance {
  double coefficient = 0;  ///< >= 0 [W/(K m^2)]
  double reference = 1;    ///< > 0 [N/m^2]
  double exponent = 1;     ///< > 0

  double value(double pressure) const;
  double derivative(double pressure) const;
};

/// Heat that crosses the contact as far as it depends on the contact's state:
///
///     q.nu = (psi k_c + h(p)) (theta - theta_f) - (share / k) tau.d
///
/// The foundation has the rest of what friction makes, and what the first term brings.
class HeatExchange : public Exchange {
 public:
  struct Parameters {
    double faded = 0;  ///< k_c, as far as it fades with the gap [W/(K m^2)]
    Ramp ramp{std::nullopt};
    PressureConductance by_pressure;
    double foundation = 0;      ///< theta_f [K]
    double friction_share = 0;  ///< share / k [1/s]
  };
  explicit HeatExchange(const Parameters &parameters) : is_(parameters) {}

  Value at(double theta, const ContactState &state) const override;

 private:
  Parameters is_;
};

}  // namespace tourmaline::contact
