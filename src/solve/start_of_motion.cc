#include "solve/start_of_motion.h"

#include <cmath>

#include "condensation/condensed_body.h"

namespace tourmaline::solve {

using body::field_of;
using body::Fields;
using body::Node;
using body::unknown;

namespace {

// What the state leaves of the equations at t = 0, rates apart; K x without history.
template <int dim>
std::vector<double> left_at_start(const Model<dim> &model, std::span<const double> state) {
  std::vector<double> loads(state.size(), 0.), product(state.size());
  model.add_loads(0, loads);
  model.op.multiply(0, state, product);
  for (std::size_t i = 0; i < loads.size(); ++i)
    loads[i] -= product[i];
  return loads;
}

// By interface node: whether its contact keeps it where it is.
template <int dim>
std::vector<bool> touching(const Model<dim> &model, std::span<const double> state) {
  std::vector<bool> touches;
  for (const contact::InterfaceNode<dim> &at : model.interface) {
    const Eigen::Map<const typename Model<dim>::Vector> u(&state[unknown<dim>(at.node, 0)]);
    const double reach = model.reach(at, 0);
    touches.push_back(!model.laws.of(at).can_open() || u.dot(at.normal) >= reach);
  }
  return touches;
}

template <int dim>
class Settling {
 public:
  Settling(const Model<dim> &model, std::vector<double> &state)
      : model_(model),
        state_(state),
        is_free_(state.size(), false),
        touches_(touching(model, state)) {
    const std::vector<bool> prescribed = body::mask_of(model.prescribed, state.size());
    for (std::size_t i = Fields<dim>::potential; i < state.size(); i += Fields<dim>::count)
      is_free_[i] = !prescribed[i];
    for (std::size_t n = 0; n < model.interface.size(); ++n)
      for (int c = 0; c < dim && !touches_[n]; ++c)
        release(n, c, prescribed);
    is_prescribed_ = prescribed;
  }

  void run() {
    constexpr int passes = 10;
    for (int i = 0; i < passes; ++i) {
      solve();
      if (!release_drawn())
        return;
    }
  }

 private:
  void release(std::size_t n, int c, const std::vector<bool> &prescribed) {
    const std::size_t i = unknown<dim>(model_.interface[n].node, c);
    is_free_[i] = !prescribed[i] && model_.op.rate_forces()->is_massless(model_.interface[n].node);
  }

  // The condensed body of what is free alone. Rows of massless nodes have what resists rates of u
  // only of damping, by which they go as far as in one step.
  void solve() {
    const std::vector<double> left = left_at_start(model_, state_);
    bool is_settled = true;
    std::vector<body::Prescribed> held;
    for (std::size_t i = 0; i < state_.size(); ++i)
      if (!is_free_[i])
        held.push_back({i, model_.body.points()[i / Fields<dim>::count], 0., ""});
      else if (left[i] != 0)
        is_settled = false;
    if (is_settled)
      return;
    condensation::CondensedBody<dim> body(model_.op, model_.step, held, {},
                                          model_.asked.solver.threads);
    std::vector<double> right_side(state_.size());
    model_.op.multiply(model_.step, state_, right_side);
    for (std::size_t i = 0; i < left.size(); ++i)
      right_side[i] += left[i];
    body.reduce(right_side, state_);
    body.expand(Eigen::VectorXd(0), state_);
  }

  // What the foundation exerts on the node has to press.
  bool release_drawn() {
    const std::vector<double> left = left_at_start(model_, state_);
    bool released = false;
    for (std::size_t n = 0; n < touches_.size(); ++n) {
      const contact::InterfaceNode<dim> &at = model_.interface[n];
      if (!touches_[n] || !model_.laws.of(at).can_open())
        continue;
      const Eigen::Map<const typename Model<dim>::Vector> force(&left[unknown<dim>(at.node, 0)]);
      if (force.dot(at.normal) >= 0)
        continue;
      touches_[n] = false;
      released = true;
      for (int c = 0; c < dim; ++c)
        release(n, c, is_prescribed_);
    }
    return released;
  }

  const Model<dim> &model_;
  std::vector<double> &state_;
  std::vector<bool> is_free_, is_prescribed_, touches_;
};

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
void settle(const Model<dim> &model, std::vector<double> &state) {
  for (const body::Prescribed &p : model.prescribed)
    if (field_of<dim>(p.unknown) == 0 ||
        (p.unknown % Fields<dim>::count == Fields<dim>::potential &&
         (p.electrode < 0 ||
          model.asked.electrodes[static_cast<std::size_t>(p.electrode)].is_driven())))
      state[p.unknown] = p.value.value(p.point, 0);
  Settling<dim>(model, state).run();
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

template void settle<2>(const Model<2> &, std::vector<double> &);
template void settle<3>(const Model<3> &, std::vector<double> &);
template std::vector<double> initial_velocity<2>(const Model<2> &);
template std::vector<double> initial_velocity<3>(const Model<3> &);
template std::vector<double> initial_acceleration<2>(const Model<2> &, std::span<const double>,
                                                     std::span<const double>);
template std::vector<double> initial_acceleration<3>(const Model<3> &, std::span<const double>,
                                                     std::span<const double>);

}  // namespace tourmaline::solve
