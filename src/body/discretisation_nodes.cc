// How nodes are numbered, and shared out to the ranks.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "discretisation_parts.h"
#include "output/place.h"
#include "parallel/ranks.h"
#include "tourmaline/error.h"

namespace tourmaline::body {

// Places of this rank's own nodes, in deal.II's order.
template <int dim>
std::vector<double> Discretisation<dim>::Parts::own_places(const Dofs &dofs) const {
  const dealii::IndexSet &own = dofs.locally_owned_dofs();
  std::vector<double> places(dim * own.n_elements());
  const ShapeTable<dim> at_nodes(*element, *linear,
                                 dealii::Quadrature<dim>(element->get_unit_support_points()));
  std::vector<dealii::types::global_dof_index> of_cell(element->n_dofs_per_cell());
  std::vector<Vector3> corners(linear->n_dofs_per_cell());
  for (const auto &cell : dofs.active_cell_iterators()) {
    if (!cell->is_locally_owned())
      continue;
    for (const unsigned int v : cell->vertex_indices())
      for (unsigned int axis = 0; axis < dim; ++axis)
        corners[v][axis] = cell->vertex(v)[axis];
    cell->get_dof_indices(of_cell);
    for (unsigned int a = 0; a < of_cell.size(); ++a)
      if (own.is_element(of_cell[a])) {
        const Vector3 place = at_nodes.place(corners, a);
        std::copy_n(place.begin(), dim, &places[dim * own.index_within_set(of_cell[a])]);
      }
  }
  return places;
}

// Every rank owns a range of deal.II's numbers; one behind the other, their places are those of all
// nodes. The node of each of these numbers.
template <int dim>
std::vector<Node> Discretisation<dim>::Parts::number_nodes(const Dofs &dofs) {
  const std::vector<double> places = parallel::joined(own_places(dofs));
  std::vector<Vector3> unsorted(dofs.n_dofs(), Vector3{});
  for (std::size_t i = 0; i < places.size(); ++i)
    unsorted[i / dim][i % dim] = places[i];
  std::vector<Node> node_of(unsorted.size());
  points.reserve(unsorted.size());
  for (const std::size_t dof : output::sorted_by_place(unsorted)) {
    node_of[dof] = static_cast<Node>(points.size());
    points.push_back(unsorted[dof]);
  }
  bounds.fill(points.front());
  for (const Vector3 &point : points)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      bounds[0][axis] = std::min(bounds[0][axis], point[axis]);
      bounds[1][axis] = std::max(bounds[1][axis], point[axis]);
    }
  return node_of;
}

// By node, whether it is one of this rank's cells.
template <int dim>
std::vector<bool> Discretisation<dim>::Parts::touched() const {
  std::vector<bool> touched(points.size(), false);
  for (const Node node : connectivity)
    touched[node] = true;
  return touched;
}

template <int dim>
void Discretisation<dim>::Parts::share_nodes(const std::vector<Node> &known) {
  sharing = NodeSharing(sharing, touched(), known);
  std::vector<Vector3> here;
  here.reserve(sharing.n_nodes());
  for (Node node = 0; node < sharing.n_nodes(); ++node)
    here.push_back(points[sharing.number(node)]);
  points = std::move(here);
  for (Node &node : connectivity)
    node = *sharing.node(node);
}

template <int dim>
void Discretisation<dim>::Parts::list_cells(const Dofs &dofs, const std::vector<Node> &node_of) {
  std::vector<dealii::types::global_dof_index> of_cell(element->n_dofs_per_cell());
  for (const auto &cell : dofs.active_cell_iterators()) {
    if (!cell->is_locally_owned())
      continue;
    regions.push_back(cell->material_id());
    cell->get_dof_indices(of_cell);
    for (const auto dof : of_cell)
      connectivity.push_back(node_of[dof]);
  }
}

template <int dim>
void Discretisation<dim>::share_nodes(const std::vector<Node> &known) {
  parts_->share_nodes(known);
}

// Meshes of other programs miss the axis by round-off. Nodes stand in the order of x.
template <int dim>
void Discretisation<dim>::Parts::find_axis() {
  const Vector3 &first = points.front();
  axis_ends = 1e-9 * std::abs(points.back()[0]);
  if (first[0] < -axis_ends)
    throw CaseError(fmt::format(
        "[model] plane = \"axisymmetric\": x is the radius, and the mesh has a node at x = {:g} m, "
        "y = {:g} m; give the half of the section with x >= 0",
        first[0], first[1]));
}

template std::vector<Node> Discretisation<2>::Parts::number_nodes(const Dofs &);
template void Discretisation<2>::Parts::list_cells(const Dofs &, const std::vector<Node> &);
template std::vector<double> Discretisation<2>::Parts::own_places(const Dofs &) const;
template std::vector<bool> Discretisation<2>::Parts::touched() const;
template void Discretisation<2>::Parts::share_nodes(const std::vector<Node> &);
template void Discretisation<2>::Parts::find_axis();
template void Discretisation<2>::share_nodes(const std::vector<Node> &);
template std::vector<Node> Discretisation<3>::Parts::number_nodes(const Dofs &);
template void Discretisation<3>::Parts::list_cells(const Dofs &, const std::vector<Node> &);
template std::vector<double> Discretisation<3>::Parts::own_places(const Dofs &) const;
template std::vector<bool> Discretisation<3>::Parts::touched() const;
template void Discretisation<3>::Parts::share_nodes(const std::vector<Node> &);
template void Discretisation<3>::Parts::find_axis();
template void Discretisation<3>::share_nodes(const std::vector<Node> &);

}  // namespace tourmaline::body
