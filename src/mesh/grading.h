#pragma once

#include <deal.II/grid/tria.h>

#include <vector>

#include "tourmaline/case/mesh_case.h"

namespace tourmaline::mesh {

/// Vertices of `cells` intervals between `min` and `max` [m], ascending. The size of the intervals
/// varies smoothly; at `min` it is 1/`at_min` of its largest value, at `max` 1/`at_max` (both
/// >= 1; 1 and 1: all equal). They are the images of equidistant points under one map that does not
/// depend on `cells`: twice as many cells keep all vertices and put one between any two.
std::vector<double> graded_line(double min, double max, int cells, double at_min, double at_max);

/// Moves the vertices of a box of equal cells to where `box.grading` wants them; the topology and
/// the boundary ids stay.
template <int dim>
void grade(dealii::Triangulation<dim> &cells, const casefile::Box &box);

}  // namespace tourmaline::mesh
