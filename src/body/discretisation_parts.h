#pragma once

#include <deal.II/base/quadrature.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe.h>
#include <deal.II/fe/mapping.h>

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "body/discretisation.h"
#include "mesh/mesh.h"

namespace tourmaline::body {

/// What a discretisation is made of, deal.II's and ours.
template <int dim>
struct Discretisation<dim>::Parts {
  using Dofs = std::vector<dealii::types::global_dof_index>;

  Parts(mesh::Mesh<dim> given, int degree, Geometry geometry);

  std::vector<double> own_places() const;
  void number_nodes();
  void list_nodes_of_cells();
  std::vector<bool> touched() const;
  void share_nodes(const std::vector<Node> &known);
  void find_dofs_here();
  Node node_of(dealii::types::global_dof_index dof) const;
  void find_axis();
  using Cell = typename dealii::DoFHandler<dim>::active_cell_iterator;
  std::span<const Node> nodes_of(std::size_t cell) const;
  template <class Face>
  bool lies_on_axis(const Face &face) const;
  template <class Values>
  void copy(const Values &from, std::span<const Node> cell_nodes, Quadrature<dim> &to) const;

  mesh::Mesh<dim> mesh;
  Geometry geometry;
  double axis_ends = 0;  // nodes up to this x [m] stand on the axis
  std::unique_ptr<dealii::FiniteElement<dim>> linear, element;
  std::unique_ptr<dealii::Mapping<dim>> mapping;
  dealii::Quadrature<dim> cell_rule, sampling_rule;
  dealii::Quadrature<dim - 1> facet_rule;
  dealii::DoFHandler<dim> dofs;
  // By deal.II's global number, which depends on the ranks; shared out, by the place of that number
  // in `dofs_here`, ascending.
  std::vector<Node> nodes_by_dof;
  Dofs dofs_here;
  NodeSharing sharing;
  std::vector<Vector3> points;  // by node
  std::array<Vector3, 2> bounds{};
  std::vector<Cell> cells;         // of this rank
  std::vector<Node> connectivity;  // cell by cell
};

}  // namespace tourmaline::body
