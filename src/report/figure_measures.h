#pragma once

#include "report/canvas.h"

namespace tourmaline::report {

// What the parts of a figure have in common; all lengths in points.
constexpr double body_size = 200, left_margin = 42, right_margin = 16, top_margin = 26,
                 axis_room = 38, line_height = 11.5;
constexpr double raster_pixels = 4;  // a point

constexpr Colour ink{29, 33, 39}, grey{120, 126, 134}, body_colour{232, 235, 239};

}  // namespace tourmaline::report
