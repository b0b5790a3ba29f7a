#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "output/records.h"

namespace tourmaline::report {

/// One array of a field file: `components` numbers for each point, or for each cell.
struct FieldArray {
  std::string name;
  std::size_t components = 1;
  bool on_points = true;
  std::vector<double> values;
};

/// What one moment's field file holds, in SI units.
struct FieldFile {
  output::Grid grid;
  std::vector<FieldArray> arrays;
};

/// Reads a .vtu file as output::VtuWriter writes it, or a .pvtu file with the pieces that it names.
/// Points that pieces share are merged, and all are then in the order of nodes.csv. Throws
/// CaseError when the file is missing or is not of this kind.
FieldFile read_field_file(const std::filesystem::path &path);

}  // namespace tourmaline::report
