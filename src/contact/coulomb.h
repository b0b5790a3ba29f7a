#pragma once

#include <limits>

#include "contact/friction_bound.h"

namespace tourmaline::contact {

/// A friction coefficient that falls (or grows) with the slip: mu(x) = kinetic + (at_rest -
/// kinetic) exp(-x/scale), where x = before + per_slip |d|. Of the slip rate, x = |d|/k; of the
/// accumulated slip, x = s, the present step's with it. A constant one has equal ends.
struct FrictionCoefficient {
  double at_rest = 0, kinetic = 0;  ///< >= 0
  double scale = 1;                 ///< > 0, in units of x
  double before = 0, per_slip = 0;

  double value(double slip) const;
  double derivative(double slip) const;  ///< in |d| [1/m]
};

/// Coulomb's law: the bound is min(cohesion + mu p, limit), but at least 0, which counts where
/// bilateral contact is pulled, p < 0.
class Coulomb : public FrictionBound {
 public:
  Coulomb(FrictionCoefficient coefficient, double cohesion,
          double limit = std::numeric_limits<double>::infinity())
      : coefficient_(coefficient), cohesion_(cohesion), limit_(limit) {}

  Value at(double pressure, double slip) const override;

 private:
  FrictionCoefficient coefficient_;
  double cohesion_, limit_;  // [N/m^2]
};

}  // namespace tourmaline::contact
