#pragma once

#include <array>
#include <cmath>

#include "../cases/read_table.h"

namespace tourmaline::verified {

using Place = std::array<double, 3>;

/// The rows of one step of a table, or of a table without steps, found by their places.
struct Rows {
  explicit Rows(const Table &table, const std::string &step = "") {
    const std::vector<double> x = table.numbers("x"), y = table.numbers("y");
    const std::vector<double> z =
        table.columns.contains("z") ? table.numbers("z") : std::vector<double>(x.size(), 0.);
    for (std::size_t i = 0; i < x.size(); ++i)
      if (step.empty() || table.columns.at("step")[i] == step) {
        row.push_back(i);
        place.push_back({x[i], y[i], z[i]});
      }
  }

  // The row whose place is `at`; there must be one.
  std::size_t nearest(const Place &at) const {
    std::size_t best = 0;
    const auto distance = [&](std::size_t k) {
      return std::hypot(place[k][0] - at[0], place[k][1] - at[1], place[k][2] - at[2]);
    };
    for (std::size_t k = 1; k < place.size(); ++k)
      if (distance(k) < distance(best))
        best = k;
    EXPECT_LT(distance(best), 1e-9);
    return row[best];
  }

  std::vector<std::size_t> row;
  std::vector<Place> place;
};

}  // namespace tourmaline::verified
