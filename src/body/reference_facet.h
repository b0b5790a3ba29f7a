#pragma once

#include <vector>

#include "shape_table.h"

namespace tourmaline::body {

/// A facet of the reference cell: its nodes by their numbers in the cell, in the order of
/// `NamedBoundary`, those of them that are corners, and the shape functions at the points of a rule
/// on it.
template <int dim>
struct ReferenceFacet {
  /// `rule`: on a facet by itself.
  ReferenceFacet(const dealii::FiniteElement<dim> &element,
                 const dealii::FiniteElement<dim> &linear, const dealii::Quadrature<dim - 1> &rule,
                 std::vector<unsigned int> facet_nodes);

  std::vector<unsigned int> nodes, corners;
  typename ShapeTable<dim>::Tangents tangents;
  ShapeTable<dim> shapes;
};

/// By deal.II's numbers of the facets.
template <int dim>
std::vector<ReferenceFacet<dim>> facets_of(const dealii::FiniteElement<dim> &element,
                                           const dealii::FiniteElement<dim> &linear,
                                           const dealii::Quadrature<dim - 1> &rule);

}  // namespace tourmaline::body
