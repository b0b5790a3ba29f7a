#pragma once

#include <filesystem>
#include <vector>

#include "solve/model.h"

namespace tourmaline::run {

/// The unknowns at the time 0 by the case. What `initial.from` names is read and kept in the model,
/// so that `body::initial_state` has it from then on; all ranks together. On another mesh it is
/// interpolated by the shape functions of that run's. Throws CaseError where there is no such
/// state, or one that cannot be the beginning of this case.
template <int dim>
std::vector<double> start_state(solve::Model<dim> &model);

/// The files that it is read from.
std::vector<std::filesystem::path> start_files(const casefile::InitialCase &initial);

/// Throws CaseError where the case starts from the folder that its own results are for.
void require_other_folder(const casefile::InitialCase &initial,
                          const std::filesystem::path &results);

}  // namespace tourmaline::run
