#include "tourmaline/contact/bilateral.h"

#include <vector>

namespace tourmaline::contact {

template <int dim>
Admissible<dim> bilateral(const Eigen::Matrix<double, dim, 1> &normal,
                          const std::array<std::optional<double>, dim> &prescribed) {
  using Vector = Eigen::Matrix<double, dim, 1>;
  Vector base = Vector::Zero(), free_normal = normal;
  std::vector<Vector> held;  // orthonormal: directions in which the displacement is known
  for (int c = 0; c < dim; ++c)
    if (prescribed[c]) {
      base[c] = *prescribed[c];
      free_normal[c] = 0;
      held.push_back(Vector::Unit(c));
    }
  if (const double size = free_normal.norm(); size > 1e-8) {
    // (9): u_nu = 0 fixes the free components along the rest of the normal.
    base -= normal.dot(base) / (size * size) * free_normal;
    held.push_back(free_normal / size);
  }
  std::vector<Vector> free_directions;
  for (int c = 0; c < dim; ++c) {
    Vector direction = Vector::Unit(c);
    for (int pass = 0; pass < 2; ++pass) {
      for (const Vector &h : held)
        direction -= h.dot(direction) * h;
      for (const Vector &f : free_directions)
        direction -= f.dot(direction) * f;
    }
    if (direction.norm() > 1e-3)
      free_directions.push_back(direction.normalized());
  }
  Admissible<dim> admissible{base, {}};
  admissible.directions.setZero(dim, static_cast<Eigen::Index>(free_directions.size()));
  for (std::size_t k = 0; k < free_directions.size(); ++k)
    admissible.directions.col(static_cast<Eigen::Index>(k)) = free_directions[k];
  return admissible;
}

template Admissible<2> bilateral<2>(const Eigen::Matrix<double, 2, 1> &,
                                    const std::array<std::optional<double>, 2> &);
template Admissible<3> bilateral<3>(const Eigen::Matrix<double, 3, 1> &,
                                    const std::array<std::optional<double>, 3> &);

}  // namespace tourmaline::contact
