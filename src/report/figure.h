#pragma once

#include <string>
#include <vector>

#include "report/canvas.h"
#include "report/result.h"
#include "report/scale.h"
#include "report/view.h"

namespace tourmaline::report {

/// One figure: a body in its frame, with axes, title, and room for a colour bar or a legend below.
class Figure {
 public:
  /// `below`: height of the room under the body, besides the axes [pt].
  Figure(const Result &result, FigureFormat format, double scale, double below);

  void title(const std::string &text);
  /// "displacement × 6·10⁷", or that nothing is deformed.
  void say_scale();
  /// How the values drawn come about, if there is something to say.
  void say_origin(const std::string &text);
  /// A field's component with its colour bar.
  void field(const Field &field, std::size_t component);
  /// The body in one colour with the sides of its cells.
  void mesh();
  void outline();
  /// Boundaries in the colours of their conditions and arrows along the poling, with a legend.
  void setting();
  void write(const std::filesystem::path &path) { canvas_.write(path); }

  struct Entry;  ///< of the legend

 private:
  Canvas::Point on_paper(std::uint32_t node) const;
  Canvas::Point on_paper(const Vector3 &place) const;
  void axes();
  void solid_axes_cross();
  void axis(int direction, const char *label);
  Raster bare_surface() const;
  void put(const Raster &raster);
  void paint_sides(const Boundary &boundary, const Colour &colour);
  void paint_faces(Raster &raster, const Boundary &boundary, const Colour &colour) const;
  void colour_bar(const ColourRange &range, const std::string &unit, const ShownRange &shown);
  void say_instead_of_bar(const std::string &text);
  void poling();
  void arrow(const Canvas::Point &tail, const Canvas::Point &tip);
  void legend();
  void mark(const Entry &entry, double y);

  const Result &result_;
  double scale_;
  View view_;
  double shift_;  ///< of all to the right, for wide numbers of the ordinate [pt]
  double left_, top_, width_, height_, per_metre_;
  Canvas canvas_;
};

/// Room for a colour bar and its numbers [pt].
constexpr double colour_bar_height = 26;
/// Room for the legend of the setting [pt].
double legend_height(const Result &result, FigureFormat format);

}  // namespace tourmaline::report
