#pragma once

#include <fmt/format.h>

#include <array>
#include <string>

#include "body/operator.h"

/// Fields that are plane waves a f(k.x + p) g(t), one for each component of u, for phi and for
/// theta, in directions k of their own. The chain rule gives every derivative as a number times f'
/// or f'', so the right-hand sides of (4)-(6) and the natural conditions are short sums, written as
/// formulas of a case.
namespace tourmaline::verified {

template <int dim>
using Vector = Eigen::Matrix<double, dim, 1>;
template <int dim>
using Voigt = Eigen::Matrix<double, dim, material::n_strains<dim>>;

/// f and its first two derivatives, `{}` standing for their argument.
using Profile = std::array<const char *, 3>;
inline const Profile sine{"sin({})", "cos({})", "-sin({})"};
inline const Profile line{"({})", "1", "0"};
inline const Profile square{"({})^2", "2*({})", "2"};

/// g(t), g'(t) and g(0).
struct Course {
  std::string value, rate;
  double at_start;
};

template <int dim>
struct Wave {
  double size;
  Vector<dim> direction;  // k
  double phase;
  Profile profile;
  Course course;
};

template <int dim>
using Waves = std::array<Wave<dim>, dim + 2>;  // u, phi, theta

template <int dim>
std::string argument(const Wave<dim> &wave) {
  std::string text = fmt::format("{:.17g}", wave.phase);
  for (int axis = 0; axis < dim; ++axis)
    text += fmt::format("+({:.17g})*{}", wave.direction[axis], "xyz"[axis]);
  return text;
}

// coefficient * a f^(order)(k.x + p) * course
template <int dim>
std::string term(double coefficient, const Wave<dim> &wave, int order, const std::string &course) {
  const std::string shape = fmt::format(fmt::runtime(wave.profile[order]), argument(wave));
  return fmt::format("+({:.17g})*({})*({})", coefficient * wave.size, shape, course);
}

// The stress vector sigma v is voigt(v) times the stress in Voigt's order; the strain of a k is
// voigt(k)^T a.
inline Voigt<2> voigt(const Vector<2> &v) {
  Voigt<2> m;
  m << v.x(), 0, 0, v.y(), 0, v.y(), 0, v.x();
  return m;
}

inline Voigt<3> voigt(const Vector<3> &v) {
  Voigt<3> m;
  m << v.x(), 0, 0, 0, v.z(), v.y(), 0, v.y(), 0, v.z(), 0, v.x(), 0, 0, v.z(), v.y(), v.x(), 0;
  return m;
}

/// Waves in a material, and what makes them a solution, as formula texts.
template <int dim>
class Manufactured {
 public:
  static constexpr int phi = body::Fields<dim>::potential, theta = body::Fields<dim>::temperature;

  Manufactured(const material::BodyConstants<dim> &material, const Waves<dim> &waves)
      : material_(material), waves_(waves) {}

  std::string value(int component) const {
    return term(1, waves_[component], 0, waves_[component].course.value);
  }
  std::string at_start(int component) const {
    return term(waves_[component].course.at_start, waves_[component], 0, "1");
  }
  std::string slope(int component, int axis) const {
    const Wave<dim> &wave = waves_[component];
    return term(wave.direction[axis], wave, 1, wave.course.value);
  }

  // (4): f_0 = -Div sigma. The divergence contracts each wave with its own direction.
  std::string force(int i) const {
    return sum([&](int c) { return -stress(c, waves_[c].direction)[i]; }, 1);
  }
  // (5)
  std::string charge() const {
    return sum([&](int c) { return electric_displacement(c, waves_[c].direction); }, 1);
  }
  // (6)
  std::string heat() const {
    const Wave<dim> &wave = waves_[theta];
    std::string text = term(-wave.direction.dot(material_.conductivity * wave.direction), wave, 2,
                            wave.course.value);
    for (int c = 0; c < dim + 2; ++c)
      text += term(material_.reference_temperature * entropy(c), waves_[c], order(c),
                   waves_[c].course.rate);
    return text;
  }
  // (8)
  std::string traction(int i, const Vector<dim> &normal) const {
    return sum([&](int c) { return stress(c, normal)[i]; }, 0);
  }
  // (11)
  std::string surface_charge(const Vector<dim> &normal) const {
    return sum([&](int c) { return electric_displacement(c, normal); }, 0);
  }
  // q.nu with (3)
  std::string heat_flux(const Vector<dim> &normal) const {
    const Wave<dim> &wave = waves_[theta];
    return term(-normal.dot(material_.conductivity * wave.direction), wave, 1, wave.course.value);
  }

 private:
  // u and phi enter (1), (2), (6) by their gradients, theta by its value.
  static int order(int component) { return component == theta ? 0 : 1; }

  template <class Coefficient>
  std::string sum(const Coefficient &coefficient, int more_derivatives) const {
    std::string text;
    for (int c = 0; c < dim + 2; ++c)
      text += term(coefficient(c), waves_[c], order(c) + more_derivatives, waves_[c].course.value);
    return text;
  }

  Vector<material::n_strains<dim>> strain(int c) const {
    return voigt(waves_[c].direction).transpose().col(c);
  }
  // What one component gives to sigma v (1), v.D (2) and the entropy in (6), per a f^(order).
  Vector<dim> stress(int c, const Vector<dim> &v) const {
    if (c == theta)
      return -voigt(v) * material_.thermal_stress;
    if (c == phi)
      return voigt(v) * material_.piezoelectric.transpose() * waves_[c].direction;
    return voigt(v) * material_.stiffness * strain(c);
  }
  double electric_displacement(int c, const Vector<dim> &v) const {
    if (c == theta)
      return v.dot(material_.pyroelectric);
    if (c == phi)
      return -v.dot(material_.permittivity * waves_[c].direction);
    return v.dot(material_.piezoelectric * strain(c));
  }
  double entropy(int c) const {
    if (c == theta)
      return material_.heat_capacity;
    if (c == phi)
      return -material_.pyroelectric.dot(waves_[c].direction);
    return material_.thermal_stress.dot(strain(c));
  }

  material::BodyConstants<dim> material_;
  Waves<dim> waves_;
};

}  // namespace tourmaline::verified
