#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include "output/records.h"

namespace tourmaline::output {

/// Field files of one grid in VTK's XML format: the points and cells are encoded once, when this is
/// built, and reused by every file.
class VtuWriter {
 public:
  /// Throws std::invalid_argument when a cell refers to a point that there is not.
  explicit VtuWriter(const Grid &grid);

  /// Writes the fields at `time` [s] to `path`, whole or not at all. Throws std::invalid_argument
  /// when a field does not have one value for each point or cell, MachineError when the file cannot
  /// be written.
  void write(const std::filesystem::path &path, double time, const PointFields &points,
             const CellFields &cells) const;

  std::size_t n_points() const { return n_points_; }
  std::size_t n_cells() const { return n_cells_; }

 private:
  std::size_t n_points_, n_cells_;
  std::string topology_;  // the elements <Points> and <Cells>
};

/// Which of the arrays that not every case has the field files hold.
struct OptionalArrays {
  bool region = false, poling = false, recovered = false;
};

/// The file (.pvtu) that joins the pieces of one step, given by their names, and the arrays in
/// them.
std::string pvtu_text(double time, std::span<const std::string> pieces,
                      const OptionalArrays &optional = {});

}  // namespace tourmaline::output
