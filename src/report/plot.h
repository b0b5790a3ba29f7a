#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "report/canvas.h"

namespace tourmaline::report {

/// Numbers over others, drawn as lines with a mark at each point; NaN is a gap.
struct Plot {
  /// One frame: `lines[i][j]` is the value of line i over the j-th abscissa.
  struct Panel {
    std::string name, unit;
    std::vector<std::vector<double>> lines;
    std::vector<std::pair<double, std::string>> words = {};  ///< of the values that are no numbers
  };

  std::string abscissa_name, abscissa_unit;
  std::vector<double> abscissae;
  bool logarithmic = false;             ///< the abscissa; its values are greater than 0
  std::vector<std::string> words = {};  ///< of the abscissae where these are no numbers
  std::vector<std::string> line_names;  ///< a legend when there are several
  std::vector<Panel> panels;
};

/// Throws MachineError.
void write_plot(const Plot &plot, FigureFormat format, const std::filesystem::path &path);

}  // namespace tourmaline::report
