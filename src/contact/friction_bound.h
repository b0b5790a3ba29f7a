#pragma once

namespace tourmaline::contact {

/// The bound of dry friction at a contact point that touches, where it depends on the state at the
/// end of the step. A point that is open has none.
class FrictionBound {
 public:
  virtual ~FrictionBound() = default;

  struct Value {
    double bound = 0;        ///< >= 0 [N/m^2]
    double by_pressure = 0;  ///< its derivative in the pressure
    double by_slip = 0;      ///< its derivative in the size of the slip increment [N/m^3]
  };
  /// `pressure` p [N/m^2]; `slip` = |d| [m], the size of the slip increment over the step.
  virtual Value at(double pressure, double slip) const = 0;
};

}  // namespace tourmaline::contact
