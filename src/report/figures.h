#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "report/canvas.h"

namespace tourmaline::report {

/// What `tourmaline figures` was asked for.
struct FigureRequest {
  FigureFormat format = FigureFormat::svg;
  /// NAME or NAME.COMPONENT, contact.COLUMN for a curve along the contact; empty: setting, deformed
  /// mesh, potential, temperature, von Mises stress
  std::vector<std::string> fields;
  std::optional<double>
      time;  ///< the state, or step, nearest to it [s], inside the run; not given: the last
};

/// Draws views of a result folder into files of `directory`, which is made when missing, without
/// browser or display. Returns the files. Throws CaseError when `folder` is no result folder, holds
/// no fields (curves along the contact need none), or has none of that name; MachineError when a
/// file cannot be written.
std::vector<std::filesystem::path> write_figures(const std::filesystem::path &folder,
                                                 const std::filesystem::path &directory,
                                                 const FigureRequest &request);

}  // namespace tourmaline::report
