#pragma once

#include <array>
#include <vector>

namespace tourmaline::solve {

/// What resists rates of u in a step, at its end unless said otherwise; empty where nothing does.
/// In two dimensions all are those of one metre of thickness.
struct RateRecord {
  std::vector<double> forces;       ///< by unknown, M a + C v [N]
  std::array<double, 3> inertia{};  ///< resultant of -M a on the body [N]
  std::array<double, 3> damping{};  ///< of -C v [N]
  double kinetic_energy = 0;        ///< [J]
  double kinetic_gained = 0;        ///< of it in this step [J]
  double dissipated = 0;            ///< by damping in this step: k v.C v of the mean velocity [J]
  double lost = 0;                  ///< by the scheme beside it [J]
};

}  // namespace tourmaline::solve
