#pragma once

#include <array>
#include <vector>

#include "solve/balance_step.h"
#include "solve/model.h"

namespace tourmaline::solve {

/// What goes in and out of a body's energy in one step [J].
struct EnergyWorks {
  double load = 0;        ///< of loads, and of what moves prescribed displacements
  double friction = 0;    ///< dissipated
  double electric = 0;    ///< of charges
  double thermal = 0;     ///< of heats
  double conduction = 0;  ///< dissipated
  double foundation = 0;  ///< of one that moves
  /// What the scheme loses by field (u, phi, theta), beside W(d).
  std::array<double, 3> by_scheme{};
};

/// `can_open`: by node, whether its contact can; empty: none can.
template <int dim>
EnergyWorks energy_works(const Model<dim> &model, const BalanceStep<dim> &step,
                         const std::vector<bool> &is_prescribed, const std::vector<bool> &can_open);

}  // namespace tourmaline::solve
