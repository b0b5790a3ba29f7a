#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sweep/reduction.h"

namespace tourmaline::casefile {
struct Case;
}

namespace tourmaline::sweep {

/// A number that a finished run has.
struct Output {
  std::string name;  ///< a column of history.csv, PROBE.COLUMN of a probe's table, or
                     ///< at_min_FIELD_x, ... of an extreme's place; with what is made of the
                     ///< column: "max:slip", "slip@0.5"
  std::string unit;
  std::string column = {};  ///< where it is not the name
  Reduction reduction = {};
};

/// All that a run of the case will have: the columns of history.csv, the places of the extremes in
/// summary.json, then the columns of probes, PROBE.COLUMN, but of those along a line.
std::vector<Output> outputs_of(const casefile::Case &asked);

/// The same of several cases; each name once.
std::vector<Output> outputs_of(const std::vector<casefile::Case> &cases);

/// How the names of extremes' places begin.
constexpr const char *of_place = "at_";

}  // namespace tourmaline::sweep
