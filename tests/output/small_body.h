#pragma once

#include <cmath>
#include <cstdint>

#include "output/records.h"

namespace tourmaline::output {

/// The unit square in 2 n^2 triangles.
inline Grid square(std::uint32_t n) {
  Grid grid;
  for (std::uint32_t j = 0; j <= n; ++j)
    for (std::uint32_t i = 0; i <= n; ++i)
      grid.points.push_back({double(i) / n, double(j) / n, 0});
  for (std::uint32_t j = 0; j < n; ++j)
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t a = j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
      grid.connectivity.insert(grid.connectivity.end(), {a, b, c, b, d, c});
    }
  return grid;
}

/// A number of no pattern, by its place and kind.
inline double value(std::size_t place, int kind) {
  return std::sin(1.7 * double(place) + kind) * std::pow(10., kind - 5);
}

inline PointFields point_fields(std::size_t n) {
  PointFields fields;
  for (std::size_t i = 0; i < n; ++i) {
    fields.displacement.push_back({value(i, -5), value(i, -6), 0});
    fields.potential.push_back(value(i, 4));
    fields.temperature.push_back(value(i, 2));
  }
  return fields;
}

inline CellFields cell_fields(std::size_t n) {
  CellFields fields;
  for (std::size_t i = 0; i < n; ++i) {
    fields.stress.push_back(
        {value(i, 10), value(i, 11), value(i, 12), value(i, 13), value(i, 14), value(i, 15)});
    fields.principal_stress.push_back({value(i, 12), value(i, 10), value(i, 11)});
    fields.von_mises.push_back(std::abs(value(i, 9)));
    fields.strain.push_back({value(i, 1), value(i, 2), 0, value(i, 3), 0, -0.});
    fields.electric_field.push_back({value(i, 3), value(i, 4), 0});
    fields.electric_displacement.push_back({value(i, 5), value(i, 6), 0});
    fields.heat_flux.push_back({value(i, 7), value(i, 8), 0});
  }
  return fields;
}

}  // namespace tourmaline::output
