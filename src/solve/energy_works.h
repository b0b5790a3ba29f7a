#pragma once

#include <array>
#include <vector>

#include "solve/balance_step.h"
#include "solve/model.h"

namespace tourmaline::solve {

/// What a contact does with a body's energy in one step [J].
struct ContactWorks {
  double friction = 0;    ///< dissipated
  double foundation = 0;  ///< of one that moves, or that takes away an interference at the start
  // Of the response of a foundation that the body can leave:
  double received = 0;    ///< from the body and by `foundation`
  double stored = 0;      ///< held at the end of the step
  double gained = 0;      ///< of it in the step
  double dissipated = 0;  ///< in the step

  /// What the step loses as the contact closes or is pressed, never negative.
  double lost() const { return received - gained - dissipated; }
  ContactWorks &operator+=(const ContactWorks &other);
};

/// What goes in and out of a body's energy in one step [J].
struct EnergyWorks {
  double load = 0;                     ///< of loads, and of what moves prescribed displacements
  double electric = 0;                 ///< of charges
  double thermal = 0;                  ///< of heats
  double conduction = 0;               ///< dissipated
  std::vector<ContactWorks> contacts;  ///< each
  ContactWorks contact;                ///< all of them
  /// What the scheme loses by field (u, phi, theta), beside W(d).
  std::array<double, 3> by_scheme{};
};

/// `can_open`: by node, whether its contact can; empty: none can.
template <int dim>
EnergyWorks energy_works(const Model<dim> &model, const BalanceStep<dim> &step,
                         const std::vector<bool> &is_prescribed, const std::vector<bool> &can_open);

}  // namespace tourmaline::solve
