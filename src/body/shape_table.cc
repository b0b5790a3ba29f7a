#include "shape_table.h"

#include <algorithm>

namespace tourmaline::body {

namespace {

// By point, then by shape function.
template <int dim>
std::vector<double> values_of(const dealii::FiniteElement<dim> &element,
                              const dealii::Quadrature<dim> &rule) {
  std::vector<double> values;
  for (const dealii::Point<dim> &point : rule.get_points())
    for (unsigned int a = 0; a < element.n_dofs_per_cell(); ++a)
      values.push_back(element.shape_value(a, point));
  return values;
}

template <int dim>
std::vector<Eigen::Matrix<double, dim, 1>> gradients_of(const dealii::FiniteElement<dim> &element,
                                                        const dealii::Quadrature<dim> &rule) {
  std::vector<Eigen::Matrix<double, dim, 1>> gradients;
  for (const dealii::Point<dim> &point : rule.get_points())
    for (unsigned int a = 0; a < element.n_dofs_per_cell(); ++a) {
      const auto gradient = element.shape_grad(a, point);
      auto &to = gradients.emplace_back();
      std::copy(gradient.begin_raw(), gradient.end_raw(), to.begin());
    }
  return gradients;
}

}  // namespace

template <int dim>
ShapeTable<dim>::ShapeTable(const dealii::FiniteElement<dim> &element,
                            const dealii::FiniteElement<dim> &linear,
                            const dealii::Quadrature<dim> &rule)
    : rule_(rule),
      is_affine_(linear.n_dofs_per_cell() == dim + 1),
      values_(values_of(element, rule)),
      linear_values_(values_of(linear, rule)),
      gradients_(gradients_of(element, rule)),
      linear_gradients_(gradients_of(linear, rule)) {}

// The gradients add up to zero. By differences a body far from the origin loses no digits.
template <int dim>
typename ShapeTable<dim>::Jacobian ShapeTable<dim>::jacobian(Corners corners, std::size_t q) const {
  Jacobian sum = Jacobian::Zero();
  for (std::size_t v = 1; v < corners.size(); ++v) {
    const auto &gradient = linear_gradients_[q * corners.size() + v];
    for (int i = 0; i < dim; ++i)
      sum.row(i) += (corners[v][i] - corners[0][i]) * gradient.transpose();
  }
  return sum;
}

template <int dim>
Vector3 ShapeTable<dim>::place(Corners corners, std::size_t q) const {
  Vector3 place{};
  for (std::size_t v = 0; v < corners.size(); ++v)
    for (std::size_t i = 0; i < dim; ++i)
      place[i] += corners[v][i] * linear_values_[q * corners.size() + v];
  return place;
}

template <int dim>
void ShapeTable<dim>::fill_places(Corners corners, Quadrature<dim> &to) const {
  to.values = values_;
  to.points.resize(rule_.size());
  to.jxw.resize(rule_.size());
  for (std::size_t q = 0; q < to.points.size(); ++q)
    to.points[q] = place(corners, q);
}

template <int dim>
void ShapeTable<dim>::fill_cell(Corners corners, Quadrature<dim> &cell) const {
  fill_places(corners, cell);
  cell.gradients.resize(gradients_.size());
  const std::size_t n_shapes = gradients_.size() / rule_.size();
  Jacobian inverse;
  double volume = 0;
  for (std::size_t q = 0; q < cell.jxw.size(); ++q) {
    if (q == 0 || !is_affine_) {
      const Jacobian of_point = jacobian(corners, q);
      inverse = of_point.inverse();
      volume = of_point.determinant();
    }
    cell.jxw[q] = volume * rule_.weight(static_cast<unsigned int>(q));
    for (std::size_t a = q * n_shapes; a < (q + 1) * n_shapes; ++a)
      Eigen::Matrix<double, dim, 1>::Map(cell.gradients[a].data()).noalias() =
          inverse.transpose() * gradients_[a];
  }
}

template <int dim>
void ShapeTable<dim>::fill_facet(Corners corners, const Tangents &tangents,
                                 Quadrature<dim> &facet) const {
  fill_places(corners, facet);
  facet.normals.resize(rule_.size());
  for (std::size_t q = 0; q < facet.jxw.size(); ++q) {
    const Tangents sides = jacobian(corners, q) * tangents;
    const Eigen::Matrix<double, dim, 1> area = across(sides);
    facet.jxw[q] = area.norm() * rule_.weight(static_cast<unsigned int>(q));
    Eigen::Matrix<double, dim, 1>::Map(facet.normals[q].data()) = area.normalized();
  }
}

template class ShapeTable<2>;
template class ShapeTable<3>;

}  // namespace tourmaline::body
