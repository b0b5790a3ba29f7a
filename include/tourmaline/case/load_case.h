#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tourmaline/case/formula.h"

namespace tourmaline::casefile {

struct LoadCase {
  FormulaVector force;  ///< f_0 [N/m^3]; empty: none
  /// of supports and foundations, which displacements are measured to: -rho times it is a force on
  /// the volume [m/s^2]; empty: none
  FormulaVector base_acceleration;
  Formula charge = 0;  ///< phi_0 [C/m^3]
  Formula heat = 0;    ///< q_0 [W/m^3]
};

/// The state at the time 0: by formulas, or that of another run.
struct InitialCase {
  FormulaVector displacement;       ///< u_0 [m]; empty: zero
  FormulaVector velocity;           ///< of the dynamic regime [m/s]; empty: zero
  Formula potential = 0;            ///< phi_0 [V]
  Formula temperature = 0;          ///< theta_0 [K]
  std::optional<std::string> from;  ///< folder of a run, whose u, phi and theta these are instead
  std::optional<int> step;          ///< of that run; none: its last one
  std::map<std::string, std::string> places;  ///< of its keys: file, line and key
  /// What was found there, by unknown; made by run::start_state.
  std::shared_ptr<const std::vector<double>> state = nullptr;
  std::map<std::string, double> charges = {};  ///< of electrodes that keep what they had there [C]
};

}  // namespace tourmaline::casefile
