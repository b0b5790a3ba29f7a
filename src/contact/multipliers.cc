#include "contact/multipliers.h"

#include <fmt/format.h>

#include <Eigen/OrderingMethods>
#include <Eigen/SparseQR>
#include <map>

#include "body/operator.h"
#include "contact/bilateral.h"
#include "tourmaline/error.h"

namespace tourmaline::contact {

using body::unknown;
using Eigen::Index;

template <int dim>
typename MultiplierPoint<dim>::Vector MultiplierPoint<dim>::mean_of(
    std::span<const double> values) const {
  Vector sum = Vector::Zero();
  for (const Share &share : mean)
    sum += share.factor * Eigen::Map<const Vector>(&values[unknown<dim>(share.node, 0)]);
  return sum;
}

template <int dim>
Local MultiplierPoint<dim>::displacement(std::span<const double> state,
                                         std::span<const double> before,
                                         std::span<const double> rest) const {
  Vector now = Vector::Zero(), change = Vector::Zero();
  for (const Share &share : mean) {
    const Eigen::Map<const Vector> u(&state[unknown<dim>(share.node, 0)]);
    const Eigen::Map<const Vector> u_before(&before[unknown<dim>(share.node, 0)]);
    const Eigen::Map<const Vector> u_rest(&rest[unknown<dim>(share.node, 0)]);
    now += share.factor * (u - u_rest);
    change += share.factor * (u - u_before);
  }
  Local y = directions.transpose() * change;
  if (has_normal)
    y[0] = directions.col(0).dot(now);
  return y;
}

template <int dim>
Tangent MultiplierPoint<dim>::held_slip(std::span<const double> state,
                                        std::span<const double> before,
                                        std::span<const double> rest) const {
  const Vector now = mean_of(state), then = mean_of(before), at_rest = mean_of(rest);
  const Tangent slip = held_now.transpose() * (now - at_rest) - held.transpose() * then;
  return beyond_round_off(slip, std::max({now.norm(), then.norm(), at_rest.norm()}));
}

template <int dim>
typename MultiplierPoint<dim>::Directions MultiplierPoint<dim>::tangent() const {
  Directions all(dim, directions.cols() - has_normal + held.cols());
  all << directions.rightCols(directions.cols() - has_normal), held;
  return all;
}

namespace {

template <int dim>
using Vector = Eigen::Matrix<double, dim, 1>;

template <int dim>
MultiplierPoint<dim> at_node(const InterfaceNode<dim> &at, const IsPrescribed &is_prescribed) {
  std::array<std::optional<double>, dim> prescribed;
  Vector<dim> free_normal = at.normal;
  Index n_free = dim;
  for (int c = 0; c < dim; ++c)
    if (is_prescribed[unknown<dim>(at.node, c)]) {
      prescribed[c] = 0.;
      free_normal[c] = 0;
      --n_free;
    }
  const Admissible<dim> admissible = bilateral<dim>(at.normal, prescribed);
  const auto &slips = admissible.directions;
  MultiplierPoint<dim> point;
  point.place = at.point;
  point.contact = at.contact;
  point.weight = at.weight;
  point.mean = {{at.node, 1}};
  point.has_normal = n_free > slips.cols();
  point.directions.resize(dim, n_free);
  if (point.has_normal)
    point.directions.col(0) = at.normal / free_normal.norm();
  point.directions.rightCols(slips.cols()) = slips;
  point.held = point.held_now = admissible.held;
  if (point.has_normal)
    point.held_now -=
        at.normal * (free_normal.transpose() * admissible.held) / free_normal.squaredNorm();
  for (int c = 0; c < dim; ++c)
    if (!admissible.is_prescribed[c])
      point.held_now.row(c).setZero();
  return point;
}

// Whether any displacement of the facet's nodes along `direction` is left free.
template <int dim>
bool is_free(const MultiplierPoint<dim> &point, const Vector<dim> &direction,
             const IsPrescribed &is_prescribed) {
  constexpr double zero_component = 1e-8;
  for (const auto &share : point.mean)
    for (int c = 0; c < dim; ++c)
      if (!is_prescribed[unknown<dim>(share.node, c)] && std::abs(direction[c]) > zero_component)
        return true;
  return false;
}

template <int dim>
typename MultiplierPoint<dim>::Directions columns(const std::vector<Vector<dim>> &vectors) {
  typename MultiplierPoint<dim>::Directions matrix(dim, static_cast<Index>(vectors.size()));
  for (std::size_t k = 0; k < vectors.size(); ++k)
    matrix.col(static_cast<Index>(k)) = vectors[k];
  return matrix;
}

template <int dim>
void set_directions(MultiplierPoint<dim> &point, const Vector<dim> &normal,
                    const IsPrescribed &is_prescribed) {
  const auto slips = bilateral<dim>(normal, {}).directions;
  std::vector<Vector<dim>> kept, held;
  point.has_normal = is_free(point, normal, is_prescribed);
  if (point.has_normal)
    kept.push_back(normal);
  for (Index k = 0; k < slips.cols(); ++k)
    (is_free<dim>(point, slips.col(k), is_prescribed) ? kept : held).push_back(slips.col(k));
  point.directions = columns<dim>(kept);
  point.held = point.held_now = columns<dim>(held);
}

template <int dim>
MultiplierPoint<dim> at_facet(const body::Quadrature<dim> &facet,
                              const IsPrescribed &is_prescribed) {
  MultiplierPoint<dim> point;
  Vector<dim> normal = Vector<dim>::Zero();
  std::map<body::Node, double> integrals;
  for (std::size_t q = 0; q < facet.jxw.size(); ++q) {
    point.weight += facet.jxw[q];
    normal += facet.jxw[q] * Eigen::Map<const Vector<dim>>(facet.normals[q].data());
    for (std::size_t c = 0; c < facet.points[q].size(); ++c)
      point.place[c] += facet.jxw[q] * facet.points[q][c];
    for (std::size_t a = 0; a < facet.nodes.size(); ++a)
      integrals[facet.nodes[a]] += facet.jxw[q] * facet.value(q, a);
  }
  for (double &component : point.place)
    component /= point.weight;
  // The cell's other nodes have no part in its facet.
  for (const auto &[node, integral] : integrals)
    if (std::abs(integral) > 1e-12 * point.weight)
      point.mean.push_back({node, integral / point.weight});
  set_directions<dim>(point, normal.normalized(), is_prescribed);
  return point;
}

// Rows: multipliers; columns: free displacements.
template <int dim>
Eigen::SparseMatrix<double> functionals(const std::vector<MultiplierPoint<dim>> &points,
                                        const IsPrescribed &is_prescribed) {
  std::vector<Eigen::Triplet<double>> entries;
  std::map<std::size_t, Index> column_of;
  Index row = 0;
  for (const MultiplierPoint<dim> &point : points)
    for (Index k = 0; k < point.n_multipliers(); ++k, ++row)
      for (const auto &share : point.mean)
        for (int c = 0; c < dim; ++c) {
          const std::size_t i = unknown<dim>(share.node, c);
          if (is_prescribed[i] || point.directions(c, k) == 0)
            continue;
          const Index next = static_cast<Index>(column_of.size());
          const Index column = column_of.try_emplace(i, next).first->second;
          entries.emplace_back(row, column, share.factor * point.directions(c, k));
        }
  Eigen::SparseMatrix<double> matrix(row, static_cast<Index>(column_of.size()));
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

template <int dim>
void require_independent(const std::vector<MultiplierPoint<dim>> &points,
                         const IsPrescribed &is_prescribed) {
  Eigen::SparseMatrix<double> rows = functionals(points, is_prescribed).transpose();
  rows.makeCompressed();
  if (rows.cols() == 0)
    return;
  const Eigen::SparseQR<Eigen::SparseMatrix<double>, Eigen::COLAMDOrdering<int>> qr(rows);
  if (qr.rank() < rows.cols())
    throw CaseError(fmt::format(
        "[solver] multiplier = \"piecewise-constant\": {} multipliers on {} free displacements of "
        "the contact boundary, of which only {} are independent, so the contact tractions are not "
        "determined; use \"nodal\" (or, in three dimensions, hexahedra, which have fewer facets, "
        "and "
        "no clamped boundary beside the contact)",
        rows.cols(), rows.rows(), qr.rank()));
}

}  // namespace

template <int dim>
std::vector<MultiplierPoint<dim>> nodal_multipliers(
    const std::vector<InterfaceNode<dim>> &interface, const IsPrescribed &is_prescribed) {
  std::vector<MultiplierPoint<dim>> points;
  for (const InterfaceNode<dim> &node : interface)
    points.push_back(at_node(node, is_prescribed));
  return points;
}

template <int dim>
std::vector<MultiplierPoint<dim>> facet_multipliers(const body::Discretisation<dim> &body,
                                                    const std::vector<std::string> &boundaries,
                                                    const IsPrescribed &is_prescribed) {
  std::vector<MultiplierPoint<dim>> points;
  body.for_each_facet(boundaries, [&](const body::Quadrature<dim> &facet) {
    points.push_back(at_facet(facet, is_prescribed));
  });
  require_independent(points, is_prescribed);
  return points;
}

template struct MultiplierPoint<2>;
template struct MultiplierPoint<3>;
template std::vector<MultiplierPoint<2>> nodal_multipliers<2>(const std::vector<InterfaceNode<2>> &,
                                                              const IsPrescribed &);
template std::vector<MultiplierPoint<3>> nodal_multipliers<3>(const std::vector<InterfaceNode<3>> &,
                                                              const IsPrescribed &);
template std::vector<MultiplierPoint<2>> facet_multipliers<2>(const body::Discretisation<2> &,
                                                              const std::vector<std::string> &,
                                                              const IsPrescribed &);
template std::vector<MultiplierPoint<3>> facet_multipliers<3>(const body::Discretisation<3> &,
                                                              const std::vector<std::string> &,
                                                              const IsPrescribed &);

}  // namespace tourmaline::contact
