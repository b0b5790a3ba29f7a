#include <deal.II/grid/grid_generator.h>

#include <array>
#include <cmath>

#include "mesh/grading.h"
#include "mesh/shapes.h"

namespace tourmaline::mesh {

namespace {

// Sides in the order of deal.II's boundary ids of a box: both ends of the first axis, of the
// second, ... The last axis points up in two and three dimensions, as the default poling does.
template <int dim>
constexpr std::array<const char *, 2 * dim> side_names();
template <>
constexpr std::array<const char *, 4> side_names<2>() {
  return {"left", "right", "bottom", "top"};
}
template <>
constexpr std::array<const char *, 6> side_names<3>() {
  return {"left", "right", "front", "back", "bottom", "top"};
}

// deal.II 9.4 does not set boundary ids by place on simplices.
template <int dim>
void name_sides(dealii::Triangulation<dim> &cells, const dealii::Point<dim> &min,
                const dealii::Point<dim> &max) {
  for (const auto &cell : cells.active_cell_iterators())
    for (const unsigned int f : cell->face_indices()) {
      if (!cell->face(f)->at_boundary())
        continue;
      const dealii::Point<dim> center = cell->face(f)->center();
      for (int axis = 0; axis < dim; ++axis) {
        const double tolerance = 1e-9 * (max[axis] - min[axis]);
        if (std::abs(center[axis] - min[axis]) < tolerance)
          cell->face(f)->set_boundary_id(2 * axis);
        else if (std::abs(center[axis] - max[axis]) < tolerance)
          cell->face(f)->set_boundary_id(2 * axis + 1);
      }
    }
}

}  // namespace

template <int dim>
Mesh<dim> box(const casefile::Box &asked) {
  dealii::Point<dim> min, max;
  std::vector<unsigned int> cells;
  for (int axis = 0; axis < dim; ++axis) {
    min[axis] = asked.min[axis];
    max[axis] = asked.max[axis];
    cells.push_back(asked.cells[axis]);
  }
  Mesh<dim> mesh;
  mesh.cells = std::make_unique<dealii::Triangulation<dim>>();
  mesh.simplices =
      asked.cell == casefile::CellShape::triangle || asked.cell == casefile::CellShape::tetrahedron;
  if (mesh.simplices)
    dealii::GridGenerator::subdivided_hyper_rectangle_with_simplices(*mesh.cells, cells, min, max);
  else
    dealii::GridGenerator::subdivided_hyper_rectangle(*mesh.cells, cells, min, max);
  name_sides(*mesh.cells, min, max);
  grade(*mesh.cells, asked);
  for (unsigned int side = 0; side < 2 * dim; ++side)
    mesh.boundaries[side_names<dim>()[side]] = {side};
  return mesh;
}

template Mesh<2> box<2>(const casefile::Box &);
template Mesh<3> box<3>(const casefile::Box &);

}  // namespace tourmaline::mesh
