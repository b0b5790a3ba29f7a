#include "report/raster.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tourmaline::report {

using Place = std::array<double, 3>;

Raster::Raster(const View &view, double per_metre)
    : left_(view.low[0]),
      top_(view.high[1]),
      per_metre_(per_metre),
      width_(std::max(1, static_cast<int>(std::ceil(view.width() * per_metre)))),
      height_(std::max(1, static_cast<int>(std::ceil(view.height() * per_metre)))),
      pixels_(static_cast<std::size_t>(width_) * height_, 0),
      depth_(pixels_.size(), std::numeric_limits<double>::infinity()) {}

Place Raster::in_pixels(const Place &place) const {
  return {(place[0] - left_) * per_metre_, (top_ - place[1]) * per_metre_, place[2]};
}

void Raster::triangle(const Place &first, const Place &second, const Place &third,
                      const Paint &paint, double slack) {
  const Place a = in_pixels(first), b = in_pixels(second), c = in_pixels(third);
  const double area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  if (area == 0)
    return;
  const auto [left, right] = std::minmax({a[0], b[0], c[0]});
  const auto [top, bottom] = std::minmax({a[1], b[1], c[1]});
  const double edge = -1e-9;  // a pixel on a side belongs to both triangles
  for (int y = std::max(0, static_cast<int>(top)); y <= std::min(height_ - 1, int(bottom)); ++y)
    for (int x = std::max(0, static_cast<int>(left)); x <= std::min(width_ - 1, int(right)); ++x) {
      const double px = x + 0.5 - a[0], py = y + 0.5 - a[1];
      const double v = (px * (c[1] - a[1]) - py * (c[0] - a[0])) / area;
      const double w = ((b[0] - a[0]) * py - (b[1] - a[1]) * px) / area;
      const double u = 1 - v - w;
      if (u < edge || v < edge || w < edge)
        continue;
      const std::size_t at = static_cast<std::size_t>(y) * width_ + x;
      const double depth = u * a[2] + v * b[2] + w * c[2];
      if (depth >= depth_[at] + slack)
        continue;
      const Colour colour = paint(u, v, w);
      depth_[at] = depth;
      pixels_[at] = 0xff000000U | static_cast<std::uint32_t>(colour[0]) << 16 |
                    static_cast<std::uint32_t>(colour[1]) << 8 | colour[2];
    }
}

void Raster::line(const Place &first, const Place &second, double slack) {
  const Place a = in_pixels(first), b = in_pixels(second);
  const int steps = 1 + static_cast<int>(std::hypot(b[0] - a[0], b[1] - a[1]));
  for (int i = 0; i <= steps; ++i) {
    const double t = static_cast<double>(i) / steps;
    const int x = static_cast<int>(a[0] + t * (b[0] - a[0])),
              y = static_cast<int>(a[1] + t * (b[1] - a[1]));
    if (x < 0 || y < 0 || x >= width_ || y >= height_)
      continue;
    const std::size_t at = static_cast<std::size_t>(y) * width_ + x;
    if (a[2] + t * (b[2] - a[2]) > depth_[at] + slack)
      continue;
    const std::uint32_t old = pixels_[at];
    pixels_[at] = (old & 0xff000000U) | ((old >> 1) & 0x7f7f7fU);
  }
}

}  // namespace tourmaline::report
