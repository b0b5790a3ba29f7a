#pragma once

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe.h>

#include <array>
#include <map>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "body/discretisation.h"
#include "mesh/mesh.h"
#include "reference_facet.h"

namespace tourmaline::body {

/// What a discretisation keeps of a mesh: plain lists of this rank's cells and of the facets that
/// may be asked for. The mesh itself, which takes several times their memory, is let go.
template <int dim>
struct Discretisation<dim>::Parts {
  Parts(const mesh::Mesh<dim> &mesh, int degree, Geometry geometry);

  /// A facet of one of this rank's cells.
  struct Facet {
    std::size_t cell;
    unsigned int number;  ///< in the cell
    unsigned int id;      ///< of the part of the boundary; inside 0
    bool is_listed;       ///< inside, by one of its two cells
  };
  using Dofs = dealii::DoFHandler<dim>;
  using Corners = std::array<Vector3, 8>;

  std::vector<double> own_places(const Dofs &dofs) const;
  std::vector<Node> number_nodes(const Dofs &dofs);
  void list_cells(const Dofs &dofs, const std::vector<Node> &node_of);
  void list_facets(const mesh::Mesh<dim> &mesh);
  std::vector<bool> touched() const;
  void share_nodes(const std::vector<Node> &known);
  void find_axis();

  std::size_t n_cells() const { return regions.size(); }  // of this rank
  std::span<const Node> nodes_of(std::size_t cell) const;
  /// The first entries of `corners` become those of the cell.
  std::span<const Vector3> corners_of(std::size_t cell, Corners &corners) const;
  std::vector<Node> nodes_of(const Facet &facet) const;
  std::vector<Vector3> corners_of(const Facet &facet) const;
  bool lies_on_axis(const Facet &facet) const;
  /// Of parts of the boundary.
  std::vector<Facet> outer_in(const std::set<unsigned int> &ids) const;
  std::set<unsigned int> ids_of(const std::vector<std::string> &names) const;
  /// On any rank's facets those that this one has, ascending.
  std::vector<Node> joined_nodes_of(const std::vector<Facet> &facets) const;
  void revolve(Quadrature<dim> &to) const;

  Geometry geometry;
  double axis_ends = 0;  // nodes up to this x [m] stand on the axis
  std::unique_ptr<dealii::FiniteElement<dim>> linear, element;
  ShapeTable<dim> shapes, sampled, centre;
  std::vector<ReferenceFacet<dim>> reference_facets;
  std::size_t n_all_cells;  // of all ranks
  NodeSharing sharing;
  std::vector<Vector3> points;  // by node
  std::array<Vector3, 2> bounds{};
  std::vector<Node> connectivity;                            // cell by cell
  std::vector<unsigned int> regions;                         // by cell
  std::vector<Facet> outer;                                  // by cell, then by number
  std::map<std::string, std::set<unsigned int>> boundaries;  // ids of `outer`, by name
  std::map<std::string, std::vector<Facet>> inner;
};

}  // namespace tourmaline::body
