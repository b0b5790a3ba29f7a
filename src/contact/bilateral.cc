#include "contact/bilateral.h"

#include <fmt/format.h>

#include <vector>

#include "body/fields.h"
#include "tourmaline/error.h"

namespace tourmaline::contact {

namespace {

template <int dim>
using Vector = Eigen::Matrix<double, dim, 1>;

// A part of the normal below this is the round-off of its computation.
constexpr double no_normal = 1e-8;

// Orthonormal columns that complete orthonormal vectors to a basis.
template <int dim>
typename Admissible<dim>::Directions completion(const std::vector<Vector<dim>> &known) {
  std::vector<Vector<dim>> found;
  for (int c = 0; c < dim; ++c) {
    Vector<dim> direction = Vector<dim>::Unit(c);
    for (int pass = 0; pass < 2; ++pass) {
      for (const Vector<dim> &k : known)
        direction -= k.dot(direction) * k;
      for (const Vector<dim> &f : found)
        direction -= f.dot(direction) * f;
    }
    if (direction.norm() > 1e-3)
      found.push_back(direction.normalized());
  }
  typename Admissible<dim>::Directions columns(dim, static_cast<Eigen::Index>(found.size()));
  for (std::size_t k = 0; k < found.size(); ++k)
    columns.col(static_cast<Eigen::Index>(k)) = found[k];
  return columns;
}

template <int dim>
Vector<dim> in_free_components(Vector<dim> v, const std::array<bool, dim> &is_prescribed) {
  for (int c = 0; c < dim; ++c)
    if (is_prescribed[c])
      v[c] = 0;
  return v;
}

}  // namespace

template <int dim>
void Admissible<dim>::set_base(const Prescribed &prescribed, double reach) {
  for (int c = 0; c < dim; ++c)
    base[c] = prescribed[c].value_or(0);
  // (9): u_nu fixes the free components along the rest of the normal.
  if (const double size = free_normal.norm(); size > 0)
    base -= (normal.dot(base) - reach) / (size * size) * free_normal;
}

template <int dim>
typename Admissible<dim>::Directions Admissible<dim>::tangent() const {
  Directions all(dim, directions.cols() + held.cols());
  all << directions, held;
  return all;
}

template <int dim>
Tangent Admissible<dim>::held_slip(const Vector &before) const {
  const Tangent slip = held.transpose() * (base - before);
  return beyond_round_off(slip, std::max(base.norm(), before.norm()));
}

template <int dim>
typename Admissible<dim>::Vector Admissible<dim>::support(const Vector &force,
                                                          const Vector &friction) const {
  const Vector rest = force - friction;
  const double size = free_normal.norm();
  const double pressure = size > 0 ? rest.dot(free_normal) / (size * size) : rest.dot(normal);
  Vector borne = rest - pressure * normal;
  for (int c = 0; c < dim; ++c)
    if (!is_prescribed[c])
      borne[c] = 0;
  return borne;
}

template <int dim>
Admissible<dim> bilateral(const Eigen::Matrix<double, dim, 1> &normal,
                          const std::array<std::optional<double>, dim> &prescribed, double reach) {
  Admissible<dim> admissible{Vector<dim>::Zero(), {}, {}, normal, Vector<dim>::Zero(), {}};
  std::vector<Vector<dim>> known;  // orthonormal: directions in which the displacement is known
  for (int c = 0; c < dim; ++c)
    if (prescribed[c]) {
      admissible.is_prescribed[c] = true;
      known.push_back(Vector<dim>::Unit(c));
    }
  const Vector<dim> free_normal = in_free_components<dim>(normal, admissible.is_prescribed);
  if (const double size = free_normal.norm(); size > no_normal) {
    admissible.free_normal = free_normal;
    known.push_back(free_normal / size);
  }
  admissible.set_base(prescribed, reach);
  admissible.directions = completion<dim>(known);
  std::vector<Vector<dim>> not_held{normal};
  for (Eigen::Index k = 0; k < admissible.directions.cols(); ++k)
    not_held.push_back(admissible.directions.col(k));
  admissible.held = completion<dim>(not_held);
  return admissible;
}

template <int dim>
typename Admissible<dim>::Prescribed prescribed_at(const InterfaceNode<dim> &at,
                                                   const std::vector<bool> &is_prescribed,
                                                   std::span<const double> state) {
  typename Admissible<dim>::Prescribed prescribed;
  for (int c = 0; c < dim; ++c)
    if (const std::size_t i = body::unknown<dim>(at.node, c); is_prescribed[i])
      prescribed[c] = state[i];
  return prescribed;
}

template <int dim>
Admissible<dim> bilateral(const InterfaceNode<dim> &at, const std::vector<bool> &is_prescribed,
                          std::span<const double> state, double reach) {
  return bilateral<dim>(at.normal, prescribed_at(at, is_prescribed, state), reach);
}

template <int dim>
void require_plain_normal(const InterfaceNode<dim> &at, const Admissible<dim> &admissible) {
  const Vector<dim> &free_normal = admissible.free_normal;
  if (free_normal.isZero(0) || (free_normal - at.normal).norm() <= no_normal)
    return;
  throw CaseError(fmt::format(
      "[contact] at ({:g}, {:g}, {:g}) some components of the displacement are prescribed, and "
      "the normal ({:g}, {:g}, {:g}) is oblique to them; contact that opens, or whose friction "
      "or exchange depends on the pressure, is not available there",
      at.point[0], at.point[1], at.point[2], at.normal[0], at.normal[1],
      dim == 3 ? at.normal[dim - 1] : 0.));
}

template struct Admissible<2>;
template Admissible<2>::Prescribed prescribed_at(const InterfaceNode<2> &,
                                                 const std::vector<bool> &,
                                                 std::span<const double>);
template Admissible<3>::Prescribed prescribed_at(const InterfaceNode<3> &,
                                                 const std::vector<bool> &,
                                                 std::span<const double>);
template void require_plain_normal<2>(const InterfaceNode<2> &, const Admissible<2> &);
template void require_plain_normal<3>(const InterfaceNode<3> &, const Admissible<3> &);
template struct Admissible<3>;
template Admissible<2> bilateral<2>(const Eigen::Matrix<double, 2, 1> &,
                                    const std::array<std::optional<double>, 2> &, double);
template Admissible<3> bilateral<3>(const Eigen::Matrix<double, 3, 1> &,
                                    const std::array<std::optional<double>, 3> &, double);
template Admissible<2> bilateral<2>(const InterfaceNode<2> &, const std::vector<bool> &,
                                    std::span<const double>, double);
template Admissible<3> bilateral<3>(const InterfaceNode<3> &, const std::vector<bool> &,
                                    std::span<const double>, double);

}  // namespace tourmaline::contact
