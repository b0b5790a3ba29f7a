#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "read_table.h"

namespace tourmaline::verified {

/// Columns that are measured by the largest of them: a component may be nothing but round-off.
using Quantity = std::vector<std::string>;

inline void expect_equal_quantities(const Table &found, const Table &expected,
                                    const std::vector<Quantity> &quantities,
                                    double tolerance = 1e-9) {
  ASSERT_EQ(found.n_rows(), expected.n_rows());
  for (const Quantity &quantity : quantities) {
    double size = 0;
    for (const std::string &column : quantity)
      size = std::max(size, largest(expected, column));
    EXPECT_GT(size, 0) << quantity.front();
    for (const std::string &column : quantity)
      EXPECT_LE(difference(found, expected, column, size), tolerance) << column;
  }
}

}  // namespace tourmaline::verified
