#pragma once

#include <string>
#include <vector>

#include "report/plot.h"
#include "sweep/member.h"
#include "sweep/outputs.h"

namespace tourmaline::sweep {

/// What became of a member.
struct Row {
  std::string status;          ///< done | failed | stopped
  std::vector<double> values;  ///< one for each output; NaN where there is none
};

/// All members of a study, one row each.
struct Results {
  std::vector<Variation> variations;
  std::vector<Member> members;
  std::vector<Output> outputs;
  std::vector<Row> rows;
  std::string key_unit;  ///< of the first variation's key
};

/// sweep.csv: member,KEY...,status,OUTPUT...; a value that holds commas stands in quotes.
std::string table_text(const Results &results);

/// Each output over the first key, a line for each value of the others.
report::Plot plot_of(const Results &results);

}  // namespace tourmaline::sweep
