#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "body/node_sharing.h"
#include "tourmaline/vector.h"

namespace tourmaline::mesh {
template <int dim>
struct Mesh;  // holds deal.II's cells: whoever makes one includes mesh/mesh.h
}
namespace tourmaline::casefile {
struct Case;
}
namespace tourmaline::output {
struct Grid;  // whoever asks for one includes output/records.h
struct NamedBoundary;
}  // namespace tourmaline::output

namespace tourmaline::body {

/// What a linear quadrilateral or hexahedron has beside its nodes' shape functions.
enum class Modes { none, incompatible };

/// What a mesh of two dimensions stands for: itself, a metre deep, or the body that it becomes by a
/// turn about the axis x = 0. There integrals go all around, with weights of 2 pi x.
enum class Geometry { cartesian, revolved };
Geometry geometry_of(const casefile::Case &asked);

/// Shape functions on one cell or one boundary facet: `nodes[a]` is the node of shape function a,
/// `value(q, a)` and `gradient(q, a)` [1/m] belong to quadrature point q with weight `jxw[q]`
/// [m^dim, facets m^(dim-1), each by a metre more where the body is revolved].
template <int dim>
struct Quadrature {
  std::vector<Node> nodes;
  std::vector<double> jxw;
  std::vector<std::array<double, 3>> points;
  std::vector<double> values;
  std::vector<std::array<double, dim>> gradients;  ///< empty on facets
  std::vector<std::array<double, dim>> normals;    ///< outward nu at each point; empty on cells
  std::size_t region = 0;                          ///< of the cell, an index of the case's regions
  /// of the dim incompatible modes [1/m], point by point; empty unless asked for
  std::vector<std::array<double, dim>> mode_gradients;
  std::vector<double> inverse_radius;   ///< at each point [1/m]; empty unless revolved, on facets
  std::vector<double> modes_by_radius;  ///< as `mode_gradients`, of what `around` is for shapes

  double value(std::size_t q, std::size_t a) const { return values[q * nodes.size() + a]; }
  const std::array<double, dim> &gradient(std::size_t q, std::size_t a) const {
    return gradients[q * nodes.size() + a];
  }
  /// The strain around the axis that a radial displacement of this shape makes, value / x [1/m].
  double around(std::size_t q, std::size_t a) const {
    return inverse_radius.empty() ? 0 : value(q, a) * inverse_radius[q];
  }
  double mode_around(std::size_t q, std::size_t m) const {
    return modes_by_radius.empty() ? 0 : modes_by_radius[q * dim + m];
  }
  std::array<double, 3> centre() const;
};

/// Shape functions at a place of the reference cell, which is (0, 1)^dim or, of simplices, has its
/// corners at 0 and 1 along each axis.
template <int dim>
struct ReferenceShapes {
  std::vector<double> values;   ///< by node of a cell
  std::vector<double> corners;  ///< by corner: of the linear ones, which say where the place is
  std::vector<std::array<double, dim>> corner_gradients;  ///< of these [1]
};

/// Neighbourhood of the nodes in compressed rows: node i shares a cell with column[row[i]] ...
/// column[row[i+1] - 1], sorted, itself included. On several ranks that of this rank's cells; rows
/// of nodes that these do not touch are empty.
struct NodeGraph {
  std::vector<std::size_t> row;
  std::vector<Node> column;

  std::size_t n_nodes() const { return row.size() - 1; }
};

/// One Lagrange space of degree 1 or 2 (28)-(30), shared by all components of u, by phi and by
/// theta: a node carries dim + 2 unknowns. Nodes are numbered by x, then y, then z, whatever the
/// mesh's own order is and however many ranks share it, so every table lists them alike. Cells are
/// shared out, and nodes with their places are whole on every rank, unless they are shared out as
/// well (`NodeSharing`). This is the only place that asks deal.II for shape functions; the rest of
/// the body sees plain numbers.
template <int dim>
class Discretisation {
 public:
  /// Throws CaseError where the mesh of a revolved body crosses its axis.
  Discretisation(const mesh::Mesh<dim> &mesh, int degree, Geometry geometry = Geometry::cartesian);
  ~Discretisation();
  Discretisation(Discretisation &&) noexcept;

  /// From now on a rank has the nodes of its cells, `known` (alike on all ranks) and node 0, and
  /// numbers them anew. All ranks together.
  void share_nodes(const std::vector<Node> &known);
  const NodeSharing &sharing() const;

  std::size_t n_nodes() const;  ///< that this rank has
  std::size_t n_cells() const;
  bool has_simplices() const;
  int degree() const;
  Geometry geometry() const;
  /// Whether the body is revolved and the node stands on its axis.
  bool is_on_axis(Node node) const;
  /// Places of the nodes [m]; z = 0 in 2D.
  const std::vector<Vector3> &points() const;
  /// The box around all nodes, whoever has them: its least and its greatest corner [m].
  const std::array<Vector3, 2> &bounds() const;
  NodeGraph graph() const;

  /// Calls `visit` for every cell of this rank, with a quadrature exact for the mass matrix on
  /// affine cells. Incompatible modes are there for quadrilaterals and hexahedra of degree 1 only.
  void for_each_cell(const std::function<void(const Quadrature<dim> &)> &visit,
                     Modes modes = Modes::none) const;
  /// The same at the points where derivatives of the fields are one order more accurate than
  /// elsewhere (Barlow 1976): the centre for degree 1; for degree 2 Gauss's points, two in each
  /// direction, or on a simplex those of a symmetric rule for cubics.
  void for_each_cell_sampled(const std::function<void(const Quadrature<dim> &)> &visit) const;
  /// Calls `visit` for every facet of the named boundaries on this rank. Throws CaseError for an
  /// unknown name.
  void for_each_facet(const std::vector<std::string> &boundaries,
                      const std::function<void(const Quadrature<dim> &)> &visit) const;
  /// The same of the facets that are on boundaries of both lists.
  void for_each_facet_on_both(const std::vector<std::string> &boundaries,
                              const std::vector<std::string> &others,
                              const std::function<void(const Quadrature<dim> &)> &visit) const;
  /// Whether facets of that name are on the boundary; else they are inside.
  bool is_boundary(const std::string &name) const;
  /// Nodes on the closure of the named boundaries, or of facets inside that have a name, ascending:
  /// of all ranks' facets those that this rank has. Facets on the axis of a revolved body have no
  /// area and count for nothing.
  std::vector<Node> nodes_on(const std::vector<std::string> &boundaries) const;
  /// The same of the facets between cells at all of whose corners `belongs` says so.
  std::vector<Node> nodes_inside(const std::function<bool(const Vector3 &)> &belongs) const;

  /// All named boundaries, and names of facets inside, with the facets of all ranks by their nodes'
  /// numbers in the whole body, on the first rank; without facets on the others.
  std::vector<output::NamedBoundary> boundaries() const;

  /// The first nodes of a cell are its corners; entry (a, v) is the share of corner v in node a,
  /// the corner's linear shape function there. Shares of a node add up to 1.
  std::vector<std::vector<double>> corner_shares() const;

  /// Calls `visit` for the nodes of every cell of this rank. Corners come first; of quadrilaterals
  /// and hexahedra x turns fastest.
  void for_each_cell_nodes(const std::function<void(std::span<const Node>)> &visit) const;
  /// The same in every cell.
  ReferenceShapes<dim> shapes_at(const std::array<double, dim> &reference) const;

  /// The grid as the output wants it: the nodes that this rank has, and its cells in the order of
  /// `for_each_cell`.
  output::Grid grid() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;

  void visit_facets(const std::set<unsigned int> &ids,
                    const std::function<void(const Quadrature<dim> &)> &visit) const;
  template <class Table>
  void visit_cells(const Table &shapes, Modes modes,
                   const std::function<void(const Quadrature<dim> &)> &visit) const;
};

}  // namespace tourmaline::body
