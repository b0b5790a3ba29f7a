#include "solve/start_of_motion.h"

#include <cmath>

namespace tourmaline::solve {

using body::field_of;
using body::Fields;
using body::Node;
using body::unknown;

namespace {

// Differences of the prescribed motion over the first steps, of order 2: one-sided, as it begins.
double first_difference(const body::Prescribed &p, double k) {
  const auto u = [&](int n) { return p.value.value(p.point, n * k); };
  return (-3 * u(0) + 4 * u(1) - u(2)) / (2 * k);
}

double second_difference(const body::Prescribed &p, double k) {
  const auto u = [&](int n) { return p.value.value(p.point, n * k); };
  return (2 * u(0) - 5 * u(1) + 4 * u(2) - u(3)) / (k * k);
}

// The components that M decides: those of nodes with mass that nothing prescribes.
template <int dim>
std::vector<bool> with_mass(const Model<dim> &model) {
  std::vector<bool> free = body::mask_of(model.prescribed, model.n_unknowns());
  for (std::size_t i = 0; i < free.size(); ++i)
    free[i] = !free[i] && field_of<dim>(i) == 0 &&
              !model.op.rate_forces()->is_massless(static_cast<Node>(i / Fields<dim>::count));
  return free;
}

// M a = force in the free components by conjugate gradients with the diagonal, whose condition
// number is that of one cell: some tens of iterations for any mesh.
template <int dim>
void solve_mass(const Model<dim> &model, const std::vector<bool> &free,
                const std::vector<double> &force, std::vector<double> &acceleration) {
  const std::vector<double> &diagonal = model.op.rate_forces()->diagonal();
  const std::size_t n = force.size();
  std::vector<double> r(n, 0.), p(n, 0.), z(n, 0.);
  const auto precondition = [&] {
    double rz = 0;
    for (std::size_t i = 0; i < n; ++i)
      if (free[i]) {
        z[i] = r[i] / diagonal[i / Fields<dim>::count];
        rz += r[i] * z[i];
      }
    return rz;
  };
  for (std::size_t i = 0; i < n; ++i)
    if (free[i])
      r[i] = force[i];
  double rz = precondition();
  const double enough = 1e-32 * rz;
  p = z;
  constexpr int most = 1000;
  for (int iteration = 0; iteration < most && rz > enough; ++iteration) {
    const std::vector<double> product =
        model.op.rate_product(body::RateForces<dim>::Kind::inertia, p);
    double curvature = 0;
    for (std::size_t i = 0; i < n; ++i)
      curvature += p[i] * product[i];
    for (std::size_t i = 0; i < n; ++i)
      if (free[i]) {
        acceleration[i] += rz / curvature * p[i];
        r[i] -= rz / curvature * product[i];
      }
    const double next = precondition();
    for (std::size_t i = 0; i < n; ++i)
      p[i] = z[i] + next / rz * p[i];
    rz = next;
  }
}

}  // namespace

template <int dim>
std::vector<double> left_at_start(const Model<dim> &model, std::span<const double> state) {
  std::vector<double> loads(state.size(), 0.), product(state.size());
  model.add_loads(0, loads);
  model.op.multiply(0, state, product);
  for (std::size_t i = 0; i < loads.size(); ++i)
    loads[i] -= product[i];
  return loads;
}

template <int dim>
std::vector<double> initial_velocity(const Model<dim> &model) {
  std::vector<double> velocity(model.n_unknowns(), 0.);
  const casefile::FormulaVector &asked = model.asked.initial.velocity;
  for (Node node = 0; node < model.body.n_nodes(); ++node)
    for (int c = 0; c < static_cast<int>(asked.size()); ++c)
      velocity[unknown<dim>(node, c)] = asked[c].value(model.body.points()[node], 0);
  for (const body::Prescribed &p : model.prescribed)
    if (field_of<dim>(p.unknown) == 0)
      velocity[p.unknown] = first_difference(p, model.step);
  return velocity;
}

template <int dim>
std::vector<double> initial_acceleration(const Model<dim> &model, std::span<const double> state,
                                         std::span<const double> velocity) {
  using Forces = body::RateForces<dim>;
  const body::RateForces<dim> &rates = *model.op.rate_forces();
  std::vector<double> acceleration(state.size(), 0.);
  for (const body::Prescribed &p : model.prescribed)
    if (field_of<dim>(p.unknown) == 0 &&
        !rates.is_massless(static_cast<Node>(p.unknown / Fields<dim>::count)))
      acceleration[p.unknown] = second_difference(p, model.step);
  std::vector<double> force = left_at_start(model, state);
  const auto subtract = [&](const std::vector<double> &product) {
    for (std::size_t i = 0; i < force.size(); ++i)
      force[i] -= product[i];
  };
  subtract(model.op.rate_product(Forces::Kind::damping, velocity));
  subtract(model.op.rate_product(Forces::Kind::backward_damping, velocity));
  subtract(model.op.rate_product(Forces::Kind::inertia, acceleration));
  solve_mass(model, with_mass(model), force, acceleration);
  return acceleration;
}

template std::vector<double> left_at_start<2>(const Model<2> &, std::span<const double>);
template std::vector<double> left_at_start<3>(const Model<3> &, std::span<const double>);
template std::vector<double> initial_velocity<2>(const Model<2> &);
template std::vector<double> initial_velocity<3>(const Model<3> &);
template std::vector<double> initial_acceleration<2>(const Model<2> &, std::span<const double>,
                                                     std::span<const double>);
template std::vector<double> initial_acceleration<3>(const Model<3> &, std::span<const double>,
                                                     std::span<const double>);

}  // namespace tourmaline::solve
