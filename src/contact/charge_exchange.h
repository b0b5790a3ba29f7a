#pragma once

#include "contact/exchange.h"

namespace tourmaline::contact {

/// Charge that crosses a contact whose conductance fades with the gap:
///
///     D.nu = before + psi c (phi - phi_f)
///
/// With before = 0 a capacitor of c [F/m^2]; with the D.nu of the step before and c = k times a
/// conductance [S/m^2] a leak, d(D.nu)/dt = psi (c/k) (phi - phi_f), by backward differences.
class ChargeExchange : public Exchange {
 public:
  struct Parameters {
    double coefficient = 0;  ///< c [F/m^2]
    Ramp ramp{std::nullopt};
    double foundation = 0;  ///< phi_f [V]
    double before = 0;      ///< [C/m^2]
  };
  explicit ChargeExchange(const Parameters &parameters) : is_(parameters) {}

  Value at(double phi, const ContactState &state) const override;

 private:
  Parameters is_;
};

}  // namespace tourmaline::contact
