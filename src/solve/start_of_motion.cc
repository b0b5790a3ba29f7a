#include "solve/start_of_motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "parallel/ranks.h"
#include "solve/conjugate_gradients.h"
#include "tourmaline/error.h"

namespace tourmaline::solve {

using body::field_of;
using body::Fields;
using body::Node;
using body::unknown;

namespace {

// Where differences of a prescribed motion are taken: at `time` and in steps of `h` beside it,
// inside the run. At its ends that is one side alone.
struct Stencil {
  double time, h, end;
  int side;  // 0: both, 1: later, -1: earlier

  Stencil(double at, double step, double end_of_run)
      : time(at), h(std::min(step, end_of_run / 3)), end(end_of_run) {
    const double round_off = 1e-6 * h;
    side = time < h - round_off ? 1 : time > end - h + round_off ? -1 : 0;
  }
  double value(const body::Prescribed &p, int n) const {
    return p.value.value(p.point, std::clamp(time + n * h, 0., end));
  }
};

// Both of order 2.
double first_difference(const body::Prescribed &p, const Stencil &at) {
  const auto u = [&](int n) { return at.value(p, n); };
  const int s = at.side;
  if (s == 0)
    return (u(1) - u(-1)) / (2 * at.h);
  return s * (-3 * u(0) + 4 * u(s) - u(2 * s)) / (2 * at.h);
}

double second_difference(const body::Prescribed &p, const Stencil &at) {
  const auto u = [&](int n) { return at.value(p, n); };
  const int s = at.side;
  if (s == 0)
    return (u(1) - 2 * u(0) + u(-1)) / (at.h * at.h);
  return (2 * u(0) - 5 * u(s) + 4 * u(2 * s) - u(3 * s)) / (at.h * at.h);
}

template <int dim>
Stencil stencil(const Model<dim> &model, double time) {
  return {time, model.step, model.time(model.steps.count())};
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

// M a = force in the free components; the condition number of M with its diagonal is that of one
// cell: some tens of iterations for any mesh.
template <int dim>
void solve_mass(const Model<dim> &model, std::vector<double> force,
                std::vector<double> &acceleration) {
  FreeUnknowns free{model.sharing(), with_mass(model), std::vector<double>(force.size()),
                    [&](const std::vector<double> &a) {
                      return model.op.rate_product(body::RateForces<dim>::Kind::inertia, a);
                    }};
  for (std::size_t i = 0; i < force.size(); ++i)
    free.diagonal[i] = model.op.rate_forces()->diagonal()[i / Fields<dim>::count];
  constexpr int most = 1000;
  const double enough = 1e-32 * free.size_of(force);
  if (!conjugate_gradients(free, std::move(force), enough, most, acceleration))
    throw SolveError(fmt::format(
        "the acceleration at t = 0 did not converge in {} iterations; look at the cells, of which "
        "some may have next to no size, and at the densities",
        most));
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
PrescribedRates prescribed_rates(const Model<dim> &model, const body::Prescribed &p, double time) {
  if (!p.value.depends_on_time())
    return {};
  const Stencil at = stencil(model, time);
  return {first_difference(p, at), second_difference(p, at)};
}

template <int dim>
std::vector<double> initial_velocity(const Model<dim> &model) {
  std::vector<double> velocity(model.n_unknowns(), 0.);
  const casefile::FormulaVector &asked = model.asked.initial.velocity;
  parallel::together([&] {
    for (Node node = 0; node < model.body.n_nodes(); ++node)
      for (int c = 0; c < static_cast<int>(asked.size()); ++c)
        velocity[unknown<dim>(node, c)] = asked[c].value(model.body.points()[node], 0);
    for (const body::Prescribed &p : model.prescribed)
      if (field_of<dim>(p.unknown) == 0)
        velocity[p.unknown] = prescribed_rates(model, p, 0).velocity;
  });
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
      acceleration[p.unknown] = prescribed_rates(model, p, 0).acceleration;
  std::vector<double> force = left_at_start(model, state);
  const auto subtract = [&](const std::vector<double> &product) {
    for (std::size_t i = 0; i < force.size(); ++i)
      force[i] -= product[i];
  };
  subtract(model.op.rate_product(Forces::Kind::damping, velocity));
  subtract(model.op.rate_product(Forces::Kind::backward_damping, velocity));
  subtract(model.op.rate_product(Forces::Kind::inertia, acceleration));
  solve_mass(model, std::move(force), acceleration);
  return acceleration;
}

template std::vector<double> left_at_start<2>(const Model<2> &, std::span<const double>);
template std::vector<double> left_at_start<3>(const Model<3> &, std::span<const double>);
template PrescribedRates prescribed_rates<2>(const Model<2> &, const body::Prescribed &, double);
template PrescribedRates prescribed_rates<3>(const Model<3> &, const body::Prescribed &, double);
template std::vector<double> initial_velocity<2>(const Model<2> &);
template std::vector<double> initial_velocity<3>(const Model<3> &);
template std::vector<double> initial_acceleration<2>(const Model<2> &, std::span<const double>,
                                                     std::span<const double>);
template std::vector<double> initial_acceleration<3>(const Model<3> &, std::span<const double>,
                                                     std::span<const double>);

}  // namespace tourmaline::solve
