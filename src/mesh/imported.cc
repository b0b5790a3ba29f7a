#include <deal.II/grid/grid_tools.h>

#include "mesh/element_table.h"
#include "mesh/shapes.h"

namespace tourmaline::mesh {

namespace {

using casefile::CellShape;
using casefile::MeshFile;

// Gmsh goes around quadrilaterals, deal.II runs x fastest.
std::vector<unsigned int> gmsh_vertex(CellShape cell) {
  switch (cell) {
    case CellShape::triangle:
      return {0, 1, 2};
    case CellShape::quadrilateral:
      return {0, 1, 3, 2};
    case CellShape::tetrahedron:
      return {0, 1, 2, 3};
    case CellShape::hexahedron:
      return {0, 1, 3, 2, 4, 5, 7, 6};
  }
  return {};
}

template <int dim>
std::vector<dealii::CellData<dim>> cells_of(const MeshFile &file) {
  const std::vector<unsigned int> order = gmsh_vertex(file.cell);
  std::vector<dealii::CellData<dim>> cells(file.n_cells());
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    cells[cell].vertices.clear();
    for (const unsigned int local : order)
      cells[cell].vertices.push_back(file.cells[cell * order.size() + local]);
  }
  return cells;
}

template <int dim>
std::vector<dealii::Point<dim>> points_of(const MeshFile &file) {
  std::vector<dealii::Point<dim>> points(file.points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    for (int axis = 0; axis < dim; ++axis)
      points[i][axis] = file.points[i][axis];
  return points;
}

// A boundary id is the index of the set of names that a facet has; of facets with a name that lies
// inside, their corners.
template <int dim>
void name_facets(Mesh<dim> &mesh, const MeshFile &file) {
  const ElementTable facets(file.facets, file.vertices_per_facet());
  const std::vector<std::string> inner = file.inner_names();
  std::vector<std::uint32_t> vertices;
  for (const auto &cell : mesh.cells->active_cell_iterators())
    for (const auto &face : cell->face_iterators()) {
      vertices.clear();
      for (const unsigned int v : face->vertex_indices())
        vertices.push_back(face->vertex_index(v));
      const auto found = facets.find(vertices);
      if (found.empty())
        continue;
      const int set = file.boundaries.set_of[found.front()];
      if (face->at_boundary())
        face->set_boundary_id(static_cast<dealii::types::boundary_id>(set));
      for (const int member : file.boundaries.sets[static_cast<std::size_t>(set)])
        if (const std::string &name = file.boundaries.names[static_cast<std::size_t>(member)];
            std::find(inner.begin(), inner.end(), name) != inner.end())
          mesh.inner[name].insert(corners_of<dim>(*face));
    }
}

}  // namespace

template <int dim>
Mesh<dim> imported(const MeshFile &file) {
  Mesh<dim> mesh;
  mesh.simplices = file.cell == CellShape::triangle || file.cell == CellShape::tetrahedron;
  mesh.cells = std::make_unique<dealii::Triangulation<dim>>();
  std::vector<dealii::CellData<dim>> cells = cells_of<dim>(file);
  // deal.II wants neighbours to agree on the direction of their common edges where it can be had.
  if (!mesh.simplices)
    dealii::GridTools::consistently_order_cells(cells);
  mesh.cells->create_triangulation(points_of<dim>(file), cells, dealii::SubCellData());
  name_facets(mesh, file);
  for (const std::string &name : file.boundary_names()) {
    const std::vector<int> sets = file.boundaries.sets_with(name);
    mesh.boundaries[name].insert(sets.begin(), sets.end());
  }
  return mesh;
}

template Mesh<2> imported<2>(const MeshFile &);
template Mesh<3> imported<3>(const MeshFile &);

}  // namespace tourmaline::mesh
