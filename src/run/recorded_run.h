#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "report/table.h"
#include "tourmaline/case/case.h"
#include "tourmaline/vector.h"

namespace tourmaline::run {

/// What the files of the run hold that `initial.from` names. All throw CaseError, at that key.
[[noreturn]] void fail_from(const casefile::InitialCase &initial, const std::string &reason);

/// The file of the state: nodes.csv, or the fields of `initial.step`.
std::filesystem::path recorded_file(const casefile::InitialCase &initial);

/// Throws where the folder holds no such file, or is of no run.
void require_recorded_file(const casefile::InitialCase &initial);

/// Throws where its last step is wanted of a run that was stopped.
void require_finished(const casefile::InitialCase &initial);

/// A state by node.
struct RecordedState {
  std::vector<Vector3> points;   ///< [m]; of field files more than nodes, where regions meet
  std::vector<double> unknowns;  ///< as body::unknown numbers them
};

template <int dim>
RecordedState recorded_state(const casefile::InitialCase &initial);

/// The case; the mesh as the folder tells of it.
casefile::Case recorded_case(const casefile::InitialCase &initial);

/// What history.csv says of the last step, or of `initial.step`; nothing of the initial state.
class RecordedRow {
 public:
  explicit RecordedRow(const casefile::InitialCase &initial);

  std::optional<double> value(const std::string &column) const;

 private:
  report::Table table_;
  std::optional<std::size_t> row_;
};

}  // namespace tourmaline::run
