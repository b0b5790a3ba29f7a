#pragma once

#include <deal.II/base/quadrature.h>
#include <deal.II/fe/fe.h>

#include <Eigen/Dense>
#include <span>
#include <vector>

#include "body/discretisation.h"

namespace tourmaline::body {

/// Shape functions at the points of a rule on the reference cell, and what becomes of them on a
/// cell that the linear ones of its corners map. No mesh is asked, as deal.II's `FEValues` would.
template <int dim>
class ShapeTable {
 public:
  using Jacobian = Eigen::Matrix<double, dim, dim>;
  using Corners = std::span<const Vector3>;

  /// `element`: of the fields; `linear`: of the corners.
  ShapeTable(const dealii::FiniteElement<dim> &element, const dealii::FiniteElement<dim> &linear,
             const dealii::Quadrature<dim> &rule);

  const dealii::Quadrature<dim> &rule() const { return rule_; }
  /// dx_i / dxi_j at point q [m].
  Jacobian jacobian(Corners corners, std::size_t q) const;
  /// Place of point q [m].
  Vector3 place(Corners corners, std::size_t q) const;
  /// Places, values, gradients and weights of a cell.
  void fill_cell(Corners corners, Quadrature<dim> &cell) const;
  /// Places and values on a facet, whose points these are; `tangents`: along its sides on the
  /// reference cell, so that their cross product points out of it. Weights and normals come from
  /// them.
  using Tangents = Eigen::Matrix<double, dim, dim - 1>;
  void fill_facet(Corners corners, const Tangents &tangents, Quadrature<dim> &facet) const;

 private:
  void fill_places(Corners corners, Quadrature<dim> &to) const;

  dealii::Quadrature<dim> rule_;
  bool is_affine_;  // the Jacobian is the same at all points
  std::vector<double> values_, linear_values_;
  std::vector<Eigen::Matrix<double, dim, 1>> gradients_, linear_gradients_;
};

/// Across a facet with these sides, as long as its area is large.
inline Eigen::Vector2d across(const Eigen::Matrix<double, 2, 1> &side) {
  return {side[1], -side[0]};
}
inline Eigen::Vector3d across(const Eigen::Matrix<double, 3, 2> &sides) {
  return sides.col(0).cross(sides.col(1));
}

}  // namespace tourmaline::body
