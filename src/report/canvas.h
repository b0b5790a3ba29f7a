#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "report/colour_map.h"
#include "report/raster.h"

namespace tourmaline::report {

enum class FigureFormat { svg, png, pdf };

/// The format of that name; throws CaseError when there is none.
FigureFormat figure_format(const std::string &name);
/// svg, png or pdf
const char *name_of(FigureFormat format);

/// A sheet of paper to draw on, in points (1/72 inch), from the top left. Letters are outlines in
/// SVG and PDF, so that a figure looks alike on every machine; PNG has 300 pixels an inch.
class Canvas {
 public:
  Canvas(FigureFormat format, double width, double height);
  ~Canvas();
  Canvas(const Canvas &) = delete;
  Canvas &operator=(const Canvas &) = delete;

  using Point = std::array<double, 2>;
  enum class Align { left, middle, right };

  void lines(const std::vector<std::vector<Point>> &paths, const Colour &colour, double width);
  void area(const std::vector<Point> &corners, const Colour &colour);
  /// A picture with its top left corner at `at`, `width` points wide.
  void picture(const Raster &raster, const Point &at, double width);
  /// From left to right.
  void colour_strip(const ColourMap &map, const Point &at, double width, double height);
  /// `at` is on the line on which the letters stand.
  void text(const std::string &text, const Point &at, Align align = Align::left, double size = 8,
            bool bold = false, bool upward = false);
  double text_width(const std::string &text, double size = 8, bool bold = false);

  /// Writes the file, whole or not at all. Nothing can be drawn any more. Throws MachineError.
  void write(const std::filesystem::path &path);

 private:
  struct Sheet;
  std::unique_ptr<Sheet> sheet_;
};

}  // namespace tourmaline::report
