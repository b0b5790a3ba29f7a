// How cells and named boundaries are handed to files of fields.

#include "discretisation_parts.h"
#include "output/records.h"
#include "parallel/ranks.h"

namespace tourmaline::body {

namespace {

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
  using Facet = typename Parts::Facet;
  std::vector<output::NamedBoundary> all;
  const auto add = [&](const std::string &name, bool inside, const std::vector<Facet> &facets) {
    std::vector<Node> listed;
    for (const Facet &facet : facets) {
      if (!facet.is_listed)
        continue;
      const std::vector<Node> nodes = parts_->sharing.numbers(parts_->nodes_of(facet));
      listed.push_back(static_cast<Node>(nodes.size()));
      listed.insert(listed.end(), nodes.begin(), nodes.end());
    }
    all.push_back({name, separated(parallel::joined_on_first(listed)), inside});
  };
  for (const auto &[name, ids] : parts_->boundaries)
    add(name, false, parts_->outer_in(ids));
  for (const auto &[name, facets] : parts_->inner)
    add(name, true, facets);
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
  grid.cell = vtk_cell(dim, has_simplices(), parts_->element->degree);
  const std::vector<unsigned int> order = vtk_order(grid.cell);
  grid.nodes_per_cell = order.size();
  grid.connectivity.reserve(parts_->connectivity.size());
  for (std::size_t i = 0; i < parts_->n_cells(); ++i)
    for (const unsigned int local : order)
      grid.connectivity.push_back(parts_->nodes_of(i)[local]);
  return grid;
}

template std::vector<output::NamedBoundary> Discretisation<2>::boundaries() const;
template std::vector<output::NamedBoundary> Discretisation<3>::boundaries() const;
template output::Grid Discretisation<2>::grid() const;
template output::Grid Discretisation<3>::grid() const;

}  // namespace tourmaline::body
