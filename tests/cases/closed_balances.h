#pragma once

#include <gtest/gtest.h>

#include <algorithm>

#include "read_table.h"
#include "run_case.h"

namespace tourmaline::verified {

/// Of energy, forces, charge and heat, in every step of history.csv.
inline void expect_closed_balances(const Table &history, double tolerance = 1e-10) {
  for (const char *column :
       {"energy_imbalance", "force_imbalance", "charge_imbalance", "heat_imbalance"})
    EXPECT_LT(largest(history, column), tolerance) << column;
}

/// Those, and that no step of time makes energy.
inline void expect_balances(const RunCase &run, double tolerance = 1e-10) {
  const Table history = run.history();
  expect_closed_balances(history, tolerance);
  const double size =
      std::max(largest(history, "stored_energy_rate"),
               std::max(largest(history, "load_power"), largest(history, "friction_dissipation")));
  for (const double loss : history.numbers("time_step_loss"))
    EXPECT_GE(loss, -1e-12 * size);
}

}  // namespace tourmaline::verified
