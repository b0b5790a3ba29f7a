// How cells and named boundaries are handed to files of fields.

#include <algorithm>

#include "discretisation_parts.h"
#include "output/records.h"
#include "parallel/ranks.h"

namespace tourmaline::body {

namespace {

// deal.II's numbers of the nodes of a line from end to end.
template <class Face>
std::vector<dealii::types::global_dof_index> line_dofs(const Face &face, unsigned int degree) {
  if (degree == 1)
    return {face.vertex_dof_index(0, 0), face.vertex_dof_index(1, 0)};
  return {face.vertex_dof_index(0, 0), face.dof_index(0), face.vertex_dof_index(1, 0)};
}

// Of a triangle or a quadrilateral: corners in a circle, then the middles of the sides from the one
// between the first two on, then the middle of a quadrilateral. deal.II has a quadrilateral's
// corners line by line, and its sides as left, right, bottom, top.
template <class Face>
std::vector<dealii::types::global_dof_index> face_dofs(const Face &face, unsigned int degree) {
  const bool is_triangle = face.n_vertices() == 3;
  std::vector<dealii::types::global_dof_index> dofs;
  for (const unsigned int corner :
       is_triangle ? std::vector{0U, 1U, 2U} : std::vector{0U, 1U, 3U, 2U})
    dofs.push_back(face.vertex_dof_index(corner, 0));
  if (degree == 1)
    return dofs;
  for (const unsigned int side :
       is_triangle ? std::vector{0U, 1U, 2U} : std::vector{2U, 1U, 3U, 0U})
    dofs.push_back(face.line(side)->dof_index(0));
  if (!is_triangle)
    dofs.push_back(face.dof_index(0));
  return dofs;
}

template <int dim, class Face>
std::vector<dealii::types::global_dof_index> facet_dofs(const Face &face, unsigned int degree) {
  if constexpr (dim == 2)
    return line_dofs(face, degree);
  else
    return face_dofs(face, degree);
}

// From (number of nodes, nodes) of each facet, one behind the other.
std::vector<std::vector<Node>> separated(const std::vector<Node> &facets) {
  std::vector<std::vector<Node>> lists;
  for (std::size_t i = 0; i < facets.size(); i += 1 + facets[i])
    lists.emplace_back(facets.begin() + i + 1, facets.begin() + i + 1 + facets[i]);
  return lists;
}

}  // namespace

template <int dim>
std::vector<output::NamedBoundary> Discretisation<dim>::boundaries() const {
  std::vector<output::NamedBoundary> all;
  const auto add = [&](const std::string &name, bool inside, const auto &is_asked) {
    std::vector<Node> facets;
    for (const auto &cell : parts_->cells)
      for (const unsigned int f : cell->face_indices()) {
        const auto is_neighbours = [&] {
          return !cell->at_boundary(f) && cell->neighbor(f)->id() < cell->id();
        };
        if (!is_asked(*cell->face(f)) || is_neighbours())
          continue;
        const auto dofs = facet_dofs<dim>(*cell->face(f), parts_->element->degree);
        facets.push_back(static_cast<Node>(dofs.size()));
        for (const auto dof : dofs)
          facets.push_back(parts_->sharing.number(parts_->node_of(dof)));
      }
    all.push_back({name, separated(parallel::joined_on_first(facets)), inside});
  };
  for (const auto &named : parts_->mesh.boundaries)
    add(named.first, false, [&](const auto &face) {
      return face.at_boundary() && named.second.contains(face.boundary_id());
    });
  for (const auto &named : parts_->mesh.inner)
    add(named.first, true,
        [&](const auto &face) { return named.second.contains(mesh::corners_of<dim>(face)); });
  return all;
}

namespace {

using output::VtkCell;

VtkCell vtk_cell(int dim, bool simplices, unsigned int degree) {
  if (simplices)
    return dim == 2 ? (degree == 1 ? VtkCell::triangle : VtkCell::quadratic_triangle)
                    : (degree == 1 ? VtkCell::tetrahedron : VtkCell::quadratic_tetrahedron);
  return dim == 2 ? (degree == 1 ? VtkCell::quadrilateral : VtkCell::quadratic_quadrilateral)
                  : (degree == 1 ? VtkCell::hexahedron : VtkCell::quadratic_hexahedron);
}

// deal.II's local node of each of VTK's. Simplices agree but for the edges of the tetrahedron;
// deal.II's tensor-product cells run x fastest and list vertices, lines, faces, interior.
std::vector<unsigned int> vtk_order(VtkCell cell) {
  switch (cell) {
    case VtkCell::triangle:
      return {0, 1, 2};
    case VtkCell::quadrilateral:
      return {0, 1, 3, 2};
    case VtkCell::tetrahedron:
      return {0, 1, 2, 3};
    case VtkCell::hexahedron:
      return {0, 1, 3, 2, 4, 5, 7, 6};
    case VtkCell::quadratic_triangle:
      return {0, 1, 2, 3, 4, 5};
    case VtkCell::quadratic_quadrilateral:
      return {0, 1, 3, 2, 6, 5, 7, 4, 8};
    case VtkCell::quadratic_tetrahedron:
      return {0, 1, 2, 3, 4, 5, 6, 7, 8, 9};
    case VtkCell::quadratic_hexahedron:
      return {0,  1,  3,  2,  4,  5,  7,  6,  10, 9,  11, 8,  14, 13,
              15, 12, 16, 17, 19, 18, 20, 21, 22, 23, 24, 25, 26};
  }
  return {};
}

}  // namespace

template <int dim>
output::Grid Discretisation<dim>::grid() const {
  output::Grid grid;
  grid.dimension = dim;
  grid.points = parts_->points;
  grid.cell = vtk_cell(dim, parts_->mesh.simplices, parts_->element->degree);
  const std::vector<unsigned int> order = vtk_order(grid.cell);
  grid.nodes_per_cell = order.size();
  grid.connectivity.reserve(parts_->connectivity.size());
  for (std::size_t i = 0; i < parts_->cells.size(); ++i)
    for (const unsigned int local : order)
      grid.connectivity.push_back(parts_->nodes_of(i)[local]);
  return grid;
}

template std::vector<output::NamedBoundary> Discretisation<2>::boundaries() const;
template std::vector<output::NamedBoundary> Discretisation<3>::boundaries() const;
template output::Grid Discretisation<2>::grid() const;
template output::Grid Discretisation<3>::grid() const;

}  // namespace tourmaline::body
