#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "report/colour_map.h"
#include "report/view.h"

namespace tourmaline::report {

/// A picture of triangles and lines that hide each other, in pixels 0xAARRGGBB, from the top left.
class Raster {
 public:
  /// Covers the rectangle of `view`; `per_metre` pixels a metre.
  Raster(const View &view, double per_metre);

  /// The colour at the corners' weights (a, b, c), which add to 1.
  using Paint = std::function<Colour(double a, double b, double c)>;
  /// `slack` [m] is how far behind what is there it may lie and still be painted over it.
  void triangle(const std::array<double, 3> &a, const std::array<double, 3> &b,
                const std::array<double, 3> &c, const Paint &paint, double slack = 0);
  /// Darkens the pixels of a line that nothing hides; `slack` [m] is how far behind a surface it
  /// may lie.
  void line(const std::array<double, 3> &a, const std::array<double, 3> &b, double slack);

  int width() const { return width_; }
  int height() const { return height_; }
  const std::vector<std::uint32_t> &pixels() const { return pixels_; }

 private:
  std::array<double, 3> in_pixels(const std::array<double, 3> &place) const;

  double left_, top_, per_metre_;
  int width_, height_;
  std::vector<std::uint32_t> pixels_;
  std::vector<double> depth_;
};

}  // namespace tourmaline::report
