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

/// Those of the given names, which one of the cases has at least; when there are no names, what one
/// looks at first. NAME or last:NAME is a column in its last row; min:, max:, mean: and rms:NAME
/// take all of it, or with @FROM..TO behind them a part of the time, NAME@T its value at the time T
/// [s]. Throws CaseError.
std::vector<Output> chosen_outputs(const std::vector<std::string> &names,
                                   const std::vector<casefile::Case> &cases);

/// Their values in a run's folder; NaN where it lacks one. Throws CaseError when the folder's files
/// cannot be read.
std::vector<double> read_outputs(const std::filesystem::path &folder,
                                 const std::vector<Output> &outputs);

}  // namespace tourmaline::sweep
