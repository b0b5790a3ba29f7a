#pragma once

#include <gtest/gtest.h>

#include "read_table.h"

namespace tourmaline::verified {

/// Of energy, forces, charge and heat, in every step of history.csv.
inline void expect_closed_balances(const Table &history, double tolerance = 1e-10) {
  for (const char *column :
       {"energy_imbalance", "force_imbalance", "charge_imbalance", "heat_imbalance"})
    EXPECT_LT(largest(history, column), tolerance) << column;
}

}  // namespace tourmaline::verified
