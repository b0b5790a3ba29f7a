#include "reference_facet.h"

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/tria.h>

#include <algorithm>
#include <utility>

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

template <int dim>
std::vector<unsigned int> corners_among(const std::vector<unsigned int> &nodes,
                                        const dealii::FiniteElement<dim> &linear) {
  std::vector<unsigned int> corners;
  std::copy_if(nodes.begin(), nodes.end(), std::back_inserter(corners),
               [&](unsigned int node) { return node < linear.n_dofs_per_cell(); });
  return corners;
}

template <int dim>
Eigen::Matrix<double, dim, 1> corner(const dealii::FiniteElement<dim> &linear, unsigned int node) {
  const dealii::Point<dim> place = linear.unit_support_point(node);
  return Eigen::Map<const Eigen::Matrix<double, dim, 1>>(place.begin_raw());
}

// From the first corner to its neighbours.
template <int dim>
typename ShapeTable<dim>::Tangents tangents_at(const std::vector<unsigned int> &corners,
                                               const dealii::FiniteElement<dim> &linear) {
  const Eigen::Matrix<double, dim, 1> first = corner(linear, corners.front());
  typename ShapeTable<dim>::Tangents tangents;
  tangents.col(0) = corner(linear, corners[1]) - first;
  tangents.col(dim - 2) = corner(linear, dim == 2 ? corners[1] : corners.back()) - first;
  Eigen::Matrix<double, dim, 1> centre = Eigen::Matrix<double, dim, 1>::Zero();
  for (unsigned int v = 0; v < linear.n_dofs_per_cell(); ++v)
    centre += corner(linear, v) / linear.n_dofs_per_cell();
  if (across(tangents).dot(first - centre) < 0)
    tangents.col(0) *= -1;
  return tangents;
}

// The facet's own rule on it.
template <int dim>
dealii::Quadrature<dim> placed(const dealii::Quadrature<dim - 1> &rule,
                               const std::vector<unsigned int> &corners,
                               const dealii::FiniteElement<dim> &linear) {
  std::vector<dealii::Point<dim>> points;
  for (const dealii::Point<dim - 1> &on_facet : rule.get_points()) {
    dealii::Point<dim> point = linear.unit_support_point(corners.front());
    for (unsigned int side = 0; side < dim - 1; ++side)
      point +=
          on_facet[side] * (linear.unit_support_point(side == 0 ? corners[1] : corners.back()) -
                            linear.unit_support_point(corners.front()));
    points.push_back(point);
  }
  return {points, rule.get_weights()};
}

}  // namespace

template <int dim>
ReferenceFacet<dim>::ReferenceFacet(const dealii::FiniteElement<dim> &element,
                                    const dealii::FiniteElement<dim> &linear,
                                    const dealii::Quadrature<dim - 1> &rule,
                                    std::vector<unsigned int> facet_nodes)
    : nodes(std::move(facet_nodes)),
      corners(corners_among(nodes, linear)),
      tangents(tangents_at(corners, linear)),
      shapes(element, linear, placed(rule, corners, linear)) {}

// deal.II numbers the facets of a mesh; the reference cell is one of one cell.
template <int dim>
std::vector<ReferenceFacet<dim>> facets_of(const dealii::FiniteElement<dim> &element,
                                           const dealii::FiniteElement<dim> &linear,
                                           const dealii::Quadrature<dim - 1> &rule) {
  dealii::Triangulation<dim> cells;
  dealii::GridGenerator::reference_cell(cells, element.reference_cell());
  dealii::DoFHandler<dim> dofs(cells);
  dofs.distribute_dofs(element);
  const auto cell = dofs.begin_active();
  std::vector<dealii::types::global_dof_index> of_cell(element.n_dofs_per_cell());
  cell->get_dof_indices(of_cell);
  std::vector<ReferenceFacet<dim>> facets;
  for (const unsigned int f : cell->face_indices()) {
    std::vector<unsigned int> nodes;
    for (const auto dof : facet_dofs<dim>(*cell->face(f), element.degree))
      nodes.push_back(static_cast<unsigned int>(std::find(of_cell.begin(), of_cell.end(), dof) -
                                                of_cell.begin()));
    facets.emplace_back(element, linear, rule, std::move(nodes));
  }
  return facets;
}

template struct ReferenceFacet<2>;
template std::vector<ReferenceFacet<2>> facets_of(const dealii::FiniteElement<2> &,
                                                  const dealii::FiniteElement<2> &,
                                                  const dealii::Quadrature<1> &);
template struct ReferenceFacet<3>;
template std::vector<ReferenceFacet<3>> facets_of(const dealii::FiniteElement<3> &,
                                                  const dealii::FiniteElement<3> &,
                                                  const dealii::Quadrature<2> &);

}  // namespace tourmaline::body
