#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tourmaline/case/formula.h"

namespace tourmaline::body {

/// An exchange with what is outside that is linear with a coefficient by place alone: it belongs to
/// the operator and the loads. Through the boundaries `on` there leaves the body, per area,
///
///     q.nu = coefficient (theta - outside)   or   D.nu = coefficient (phi - outside),
///
/// or, where it accumulates, `factor` times that is what it adds to D.nu in a step.
struct SurfaceExchange {
  enum Field : std::uint8_t { potential, temperature } field;
  std::vector<std::string> on;
  casefile::Formula coefficient;  ///< [W/(K m^2)], [F/m^2]
  casefile::Formula outside;      ///< [K], [V]
  double factor = 1;              ///< the coefficient counts so many times; of heat 1
  bool accumulates = false;
};

}  // namespace tourmaline::body
