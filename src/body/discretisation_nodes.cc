// How nodes are numbered, and shared out to the ranks.

#include <deal.II/fe/fe_values.h>

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
std::vector<double> Discretisation<dim>::Parts::own_places() const {
  const dealii::IndexSet &own = dofs.locally_owned_dofs();
  std::vector<double> places(dim * own.n_elements());
  dealii::FEValues<dim> at_nodes(*mapping, *element,
                                 dealii::Quadrature<dim>(element->get_unit_support_points()),
                                 dealii::update_quadrature_points);
  Dofs of_cell(element->n_dofs_per_cell());
  for (const auto &cell : cells) {
    at_nodes.reinit(cell);
    cell->get_dof_indices(of_cell);
    for (unsigned int a = 0; a < of_cell.size(); ++a)
      if (own.is_element(of_cell[a]))
        for (int axis = 0; axis < dim; ++axis)
          places[dim * own.index_within_set(of_cell[a]) + axis] =
              at_nodes.quadrature_point(a)[axis];
  }
  return places;
}

// Every rank owns a range of deal.II's numbers; one behind the other, their places are those of all
// nodes.
template <int dim>
void Discretisation<dim>::Parts::number_nodes() {
  const std::vector<double> places = parallel::joined(own_places());
  std::vector<Vector3> unsorted(dofs.n_dofs(), Vector3{});
  for (std::size_t i = 0; i < places.size(); ++i)
    unsorted[i / dim][i % dim] = places[i];
  nodes_by_dof.resize(unsorted.size());
  points.reserve(unsorted.size());
  for (const std::size_t dof : output::sorted_by_place(unsorted)) {
    nodes_by_dof[dof] = static_cast<Node>(points.size());
    points.push_back(unsorted[dof]);
  }
  bounds.fill(points.front());
  for (const Vector3 &point : points)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      bounds[0][axis] = std::min(bounds[0][axis], point[axis]);
      bounds[1][axis] = std::max(bounds[1][axis], point[axis]);
    }
}

template <int dim>
Node Discretisation<dim>::Parts::node_of(dealii::types::global_dof_index dof) const {
  if (dofs_here.empty())
    return nodes_by_dof[dof];
  const auto at = std::lower_bound(dofs_here.begin(), dofs_here.end(), dof);
  return nodes_by_dof[static_cast<std::size_t>(at - dofs_here.begin())];
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
  find_dofs_here();
}

template <int dim>
void Discretisation<dim>::Parts::find_dofs_here() {
  Dofs of_cell(element->n_dofs_per_cell());
  for (const auto &cell : cells) {
    cell->get_dof_indices(of_cell);
    dofs_here.insert(dofs_here.end(), of_cell.begin(), of_cell.end());
  }
  std::sort(dofs_here.begin(), dofs_here.end());
  dofs_here.erase(std::unique(dofs_here.begin(), dofs_here.end()), dofs_here.end());
  dofs_here.shrink_to_fit();
  std::vector<Node> nodes;
  nodes.reserve(dofs_here.size());
  for (const auto dof : dofs_here)
    nodes.push_back(*sharing.node(nodes_by_dof[dof]));
  nodes_by_dof = std::move(nodes);
}

template <int dim>
void Discretisation<dim>::Parts::list_nodes_of_cells() {
  Dofs of_cell(element->n_dofs_per_cell());
  connectivity.reserve(cells.size() * of_cell.size());
  for (const auto &cell : cells) {
    cell->get_dof_indices(of_cell);
    for (const auto dof : of_cell)
      connectivity.push_back(nodes_by_dof[dof]);
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

template void Discretisation<2>::Parts::number_nodes();
template void Discretisation<2>::Parts::list_nodes_of_cells();
template std::vector<double> Discretisation<2>::Parts::own_places() const;
template Node Discretisation<2>::Parts::node_of(dealii::types::global_dof_index) const;
template std::vector<bool> Discretisation<2>::Parts::touched() const;
template void Discretisation<2>::Parts::share_nodes(const std::vector<Node> &);
template void Discretisation<2>::Parts::find_dofs_here();
template void Discretisation<2>::Parts::find_axis();
template void Discretisation<2>::share_nodes(const std::vector<Node> &);
template void Discretisation<3>::Parts::number_nodes();
template void Discretisation<3>::Parts::list_nodes_of_cells();
template std::vector<double> Discretisation<3>::Parts::own_places() const;
template Node Discretisation<3>::Parts::node_of(dealii::types::global_dof_index) const;
template std::vector<bool> Discretisation<3>::Parts::touched() const;
template void Discretisation<3>::Parts::share_nodes(const std::vector<Node> &);
template void Discretisation<3>::Parts::find_dofs_here();
template void Discretisation<3>::Parts::find_axis();
template void Discretisation<3>::share_nodes(const std::vector<Node> &);

}  // namespace tourmaline::body
