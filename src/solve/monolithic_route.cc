#include "solve/monolithic_route.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "body/backward_error.h"
#include "case/holding.h"
#include "contact/yosida_normal.h"
#include "larger.h"
#include "parallel/ranks.h"
#include "solve/first_places.h"
#include "solve/held_bounds.h"
#include "solve/held_exchanges.h"
#include "solve/leaning.h"
#include "solve/rigid_work.h"
#include "solve/saddle_contact.h"
#include "solve/saddle_newton.h"
#include "solve/spring_path.h"
#include "stopwatch.h"
#include "tourmaline/error.h"

namespace tourmaline::solve {

namespace {

using contact::AugmentedLagrangian;
using Eigen::Index;
using Eigen::VectorXd;

template <int dim>
std::vector<contact::MultiplierPoint<dim>> multiplier_points(const Model<dim> &model) {
  if (model.asked.contacts.empty())
    return {};
  const contact::IsPrescribed is_prescribed = body::mask_of(model.prescribed, model.n_unknowns());
  if (model.asked.solver.multiplier == "nodal")
    return contact::nodal_multipliers(model.interface, is_prescribed);
  if (parallel::n_ranks() > 1)
    throw CaseError(model.asked.source +
                    ": [solver] multiplier: \"piecewise-constant\" is not available on several MPI "
                    "ranks; start the program without mpirun, or take \"nodal\"");
  return contact::facet_multipliers(model.body, model.asked.contacts.front().on, is_prescribed);
}

template <int dim>
class MonolithicRoute : public Route {
 public:
  explicit MonolithicRoute(const Model<dim> &model);

  StepOutcome advance(double time, std::span<const double> right_side,
                      std::span<const double> before, std::span<double> state) override;
  Accuracy accuracy(std::span<const double> right_side, std::span<const double> state,
                    const StepOutcome &outcome) override;
  void take_back() override {
    contact_.take_back();
    exchange_.take_back();
  }

 private:
  void find(double time, const StepData &data, const SaddlePoint &start, StepOutcome &outcome);
  void find_leaning(double time, const StepData &data, SaddlePoint start, StepOutcome &outcome);
  bool follow_springs_to(SaddlePoint &x, const StepData &data, StepOutcome &outcome);
  std::string unheld(const StepData &data, const SaddleNewton<dim> &newton) const;
  void find_stuck(double time, const StepData &data, std::vector<AugmentedLagrangian> &laws,
                  const SaddlePoint &start, StepOutcome &outcome);
  bool is_carried_off(double time, const StepData &data, const SaddleNewton<dim> &newton,
                      double first_force_size) const;
  void take(const SaddleNewton<dim> &newton, StepOutcome &outcome);
  void find_with_bounds(double time, const StepData &data, std::vector<AugmentedLagrangian> &laws,
                        SaddlePoint start, StepOutcome &outcome);
  void find_with_exchanges(double time, const StepData &data,
                           std::vector<AugmentedLagrangian> &laws, std::span<double> right_side,
                           SaddlePoint start, StepOutcome &outcome);
  SaddlePoint prediction(std::span<const double> before, std::span<const double> state) const;
  [[noreturn]] void give_up(double time, const SaddleNewton<dim> &newton) const;

  SaddleSettings settings() const {
    return {model_.asked.solver.tolerance, model_.asked.solver.max_iterations, least_iterations_};
  }
  void describe(RouteReport &report) const override;
  void save_memory(output::SavedNumbers &numbers) const override;
  void restore_memory(const output::SavedNumbers &numbers) override;

  const Model<dim> &model_;
  HeldExchanges<dim> exchange_;
  SaddleSystem<dim> system_;
  SaddleContact<dim> contact_;
  const std::string left_to_contact_;  // rigid motions
  SaddlePoint x_;
  double force_size_ = 0;     // of the step at hand [N]
  int least_iterations_ = 0;  // of a solution, likewise
};

template <int dim>
MonolithicRoute<dim>::MonolithicRoute(const Model<dim> &model)
    : model_(model),
      exchange_(model),
      system_(model.op, model.step, model.prescribed, multiplier_points(model),
              unknowns_of(exchange_.sites()), model.asked.solver.threads),
      contact_(model, system_),
      left_to_contact_(resisted_by_contact_alone(model)) {
  x_.multipliers = VectorXd::Zero(static_cast<Index>(system_.n_multipliers()));
}

// Prediction step of 3.2: everything as it was, but for what is prescribed at the new time.
template <int dim>
SaddlePoint MonolithicRoute<dim>::prediction(std::span<const double> before,
                                             std::span<const double> state) const {
  SaddlePoint x{{before.begin(), before.end()}, x_.multipliers};
  for (const body::Prescribed &p : model_.prescribed)
    x.body[p.unknown] = state[p.unknown];
  return x;
}

template <int dim>
StepOutcome MonolithicRoute<dim>::advance(double time, std::span<const double> right_side,
                                          std::span<const double> before, std::span<double> state) {
  std::vector<double> storage;
  const std::span<const double> carried = model_.carried(before, time, storage);
  contact_.begin_step(time, before);
  least_iterations_ = 0;
  const std::vector<double> rest = contact_.rest();
  std::vector<AugmentedLagrangian> laws = contact_.laws(carried, state, rest);
  std::vector<double> held(right_side.begin(), right_side.end());
  const StepData data{held, carried, rest, laws};
  StepOutcome outcome;
  find_with_exchanges(time, data, laws, held, prediction(before, state), outcome);
  outcome.status = contact_.status(data, x_);
  if (model_.asked.solver.multiplier == "nodal")
    contact_.settle(data, outcome.status, x_);
  contact_.share_forces(data, x_, outcome);
  contact_.end_step(data, x_, outcome);
  const auto crossing = contact_.states_for_exchange(data, x_);
  exchange_.end_step(
      x_.body, [&](std::size_t node) { return crossing[node]; }, outcome);
  std::copy(x_.body.begin(), x_.body.end(), state.begin());
  if (outgrew_measured<dim>(model_.sharing(), state)) {
    Stopwatch watch;
    see_forward_error(accuracy(right_side, state, outcome).forward_error);
    so_far_.estimate_seconds += watch.lap();
  }
  return outcome;
}

// At points that are not always closed.
bool may_open(const std::vector<AugmentedLagrangian> &laws) {
  return std::any_of(laws.begin(), laws.end(), [](const AugmentedLagrangian &law) {
    return law.has_normal && law.normal != nullptr;
  });
}

template <int dim>
void MonolithicRoute<dim>::find(double time, const StepData &data, const SaddlePoint &start,
                                StepOutcome &outcome) {
  if (!left_to_contact_.empty() && !data.laws.empty())
    return find_leaning(time, data, start, outcome);
  SaddleNewton<dim> newton(system_, data, start);
  if (newton.solve(settings()))
    return take(newton, outcome);
  outcome.newton_iterations += newton.iterations();
  if (SaddlePoint x = start; follow_springs_to(x, data, outcome)) {
    SaddleNewton<dim> from_springs(system_, data, std::move(x));
    if (from_springs.solve(settings()))
      return take(from_springs, outcome);
  }
  give_up(time, newton);
}

// From x to the solution with the stiffest springs; false where there is no such way.
template <int dim>
bool MonolithicRoute<dim>::follow_springs_to(SaddlePoint &x, const StepData &data,
                                             StepOutcome &outcome) {
  if (!may_open(data.laws))
    return false;
  constexpr double little = 1e-3;  // of a spring, what may lean beside it
  std::vector<AugmentedLagrangian> sprung = data.laws;
  return follow_springs([&](double stiffness) {
    for (std::size_t p = 0; p < sprung.size(); ++p) {
      const double spring = stiffness * system_.stiffness_at(p);
      if (data.laws[p].normal)
        sprung[p].normal = std::make_shared<contact::YosidaNormal>(data.laws[p].normal, spring);
      sprung[p].lean = std::min(data.laws[p].lean, little * spring);
    }
    SaddleNewton<dim> newton(system_, {data.right_side, data.before, data.rest, sprung}, x);
    const bool is_solved = newton.solve(settings());
    outcome.newton_iterations += newton.iterations();
    if (is_solved)
      x = newton.x();
    return is_solved;
  });
}

// Where only the contact holds the body, Newton's method may lose it on its way. Weak springs
// between contact and foundation lead it to where the contact holds.
template <int dim>
void MonolithicRoute<dim>::find_leaning(double time, const StepData &data, SaddlePoint start,
                                        StepOutcome &outcome) {
  const double first_force_size = system_.row_sizes(data, start).of_field[0];
  constexpr std::array weak{1e-2, 1e-4, 1e-6};
  constexpr double slightly = 1e-10;
  std::vector<AugmentedLagrangian> leaning = data.laws;
  for (std::size_t p = 0; p < leaning.size(); ++p)
    leaning[p].lean = slightly * system_.stiffness_at(p);
  const StepData with_lean{data.right_side, data.before, data.rest, leaning};
  const SaddlePoint first = start;
  for (std::size_t k = 0; true; ++k) {
    SaddleNewton<dim> newton(system_, with_lean, start);
    const bool is_solved = newton.solve(settings());
    if (is_solved && !is_carried_off(time, data, newton, first_force_size))
      return take(newton, outcome);
    outcome.newton_iterations += newton.iterations();
    if (k == weak.size()) {
      if (SaddlePoint x = first; follow_springs_to(x, with_lean, outcome)) {
        SaddleNewton<dim> from_springs(system_, with_lean, std::move(x));
        if (from_springs.solve(settings()) &&
            !is_carried_off(time, data, from_springs, first_force_size))
          return take(from_springs, outcome);
      }
      if (is_solved)
        let_go(time, unheld(data, newton));
      give_up(time, newton);
    }
    std::vector<AugmentedLagrangian> sprung = leaning;
    for (std::size_t p = 0; p < sprung.size(); ++p)
      sprung[p].spring = weak[k] * system_.stiffness_at(p);
    SaddleNewton<dim> held(system_, {data.right_side, data.before, data.rest, sprung}, start);
    held.solve(settings());
    outcome.newton_iterations += held.iterations();
    start = held.x();
  }
}

template <int dim>
std::string MonolithicRoute<dim>::unheld(const StepData &data,
                                         const SaddleNewton<dim> &newton) const {
  const std::string motions = unheld_motions(model_, contact_.status(data, newton.x()));
  return motions.empty() ? left_to_contact_ : motions;
}

// Where nothing holds the body, what the tangent has beside its stiffness does: loads then move it
// until their rest is small beside the terms of its forces, though not beside themselves. Without
// any load that may be so of a body that its foundation carries along: forces are asked.
template <int dim>
bool MonolithicRoute<dim>::is_carried_off(double time, const StepData &data,
                                          const SaddleNewton<dim> &newton,
                                          double first_force_size) const {
  constexpr double counts = 1e-4;
  const Verdict verdict = newton.verdict();
  if (verdict.blocks[0] * verdict.force_size <= counts * first_force_size)
    return false;
  const std::vector<ContactStatus> status = contact_.status(data, newton.x());
  if (unheld_motions(model_, status).empty())
    return false;
  RigidWork work = RigidWork::left_to_contact(model_);
  work.add_loads(model_, data.right_side);
  work.add_at_contact(model_, contact_.holding_forces(data, newton.x()));
  return !(work.imbalance(RigidWork::uncertain, round_off_where_held(model_, time, status)) <=
           RigidWork::allowed(model_.asked.solver, true));
}

template <int dim>
void MonolithicRoute<dim>::take(const SaddleNewton<dim> &newton, StepOutcome &outcome) {
  x_ = newton.x();
  const Verdict verdict = newton.verdict();
  see_backward_error(verdict.body());
  outcome.newton_iterations += newton.iterations();
  outcome.residual = verdict.worst();
  force_size_ = verdict.force_size;
}

// `laws` and `right_side` are those of `data`: what crosses by the contact's state is held, the
// step solved, and so on.
template <int dim>
void MonolithicRoute<dim>::find_with_exchanges(double time, const StepData &data,
                                               std::vector<AugmentedLagrangian> &laws,
                                               std::span<double> right_side, SaddlePoint start,
                                               StepOutcome &outcome) {
  const std::vector<AugmentedLagrangian> own = laws;
  const std::vector<double> loads(right_side.begin(), right_side.end());
  exchange_.begin_step(time, start.body);
  while (true) {
    laws = own;
    std::copy(loads.begin(), loads.end(), right_side.begin());
    exchange_.add_rests(right_side);
    system_.set_slopes(exchange_.slopes());
    if (model_.laws.friction_depends_on_pressure())
      find_with_bounds(time, data, laws, start, outcome);
    else
      find(time, data, start, outcome);
    if (exchange_.is_empty())
      return;
    start = x_;
    const auto states = contact_.states_for_exchange(data, x_);
    if (exchange_.settle(
            time, x_.body, [&](std::size_t node) { return states[node]; },
            model_.asked.solver.tolerance))
      break;
  }
  outcome.stage = ContactStage::fixed_point;
}

// `laws` are those of `data`: friction is held, the step solved, and so on.
template <int dim>
void MonolithicRoute<dim>::find_with_bounds(double time, const StepData &data,
                                            std::vector<AugmentedLagrangian> &laws,
                                            SaddlePoint start, StepOutcome &outcome) {
  constexpr int most = 200;
  contact_.see_touching({});
  std::vector<contact::PointLaw> own;
  double least_weight = std::numeric_limits<double>::infinity();
  for (std::size_t p = 0; p < laws.size(); ++p) {
    own.push_back(laws[p].friction);
    least_weight = std::min(least_weight, system_.points()[p].weight);
  }
  HeldBounds held(contact_.bounds(), own, dim - 1, contact_.first_states(x_));
  bool may_stick = !left_to_contact_.empty();
  for (int k = 0; k < most; ++k) {
    for (std::size_t p = 0; p < laws.size(); ++p)
      laws[p].friction = held.law(p);
    // An answer to a change of bounds within the tolerance has to be known, too.
    least_iterations_ = held.is_undecided() ? 1 : 0;
    try {
      find(time, data, start, outcome);
    } catch (const SolveError &) {
      if (!std::exchange(may_stick, false))
        throw;
      find_stuck(time, data, laws, start, outcome);
      start = x_;
      held = {contact_.bounds(), own, dim - 1, contact_.states(data, x_)};
      continue;
    }
    start = x_;
    const std::vector<HeldBounds::State> states = contact_.states(data, x_);
    // By the pressures: forces inside the body may be larger by many powers of ten.
    double settled = std::numeric_limits<double>::epsilon() * force_size_ / least_weight;
    for (const HeldBounds::State &state : states)
      settled = larger(settled, model_.asked.solver.tolerance * std::abs(state.pressure));
    if (held.settle(states, settled)) {
      outcome.stage = ContactStage::fixed_point;
      outcome.friction_bound = VectorXd::Zero(static_cast<Index>(laws.size()));
      for (std::size_t p = 0; p < laws.size(); ++p)
        outcome.friction_bound[static_cast<Index>(p)] = laws[p].friction.bound().value_or(0);
      std::vector<bool> just_touches;
      for (std::size_t p = 0; p < laws.size(); ++p)
        just_touches.push_back(held.just_touches(p));
      contact_.see_touching(std::move(just_touches));
      return;
    }
  }
  throw UnsettledStep(fmt::format(
      "the friction bounds, which follow the pressure, did not settle at t = {:g} s in {} rounds; "
      "take smaller time steps, or solver.method = \"condensed\"",
      time, most));
}

// With the bounds of the last step, or of none, friction may not hold a body that it holds with the
// pressures of this step: those where all points stick.
template <int dim>
void MonolithicRoute<dim>::find_stuck(double time, const StepData &data,
                                      std::vector<AugmentedLagrangian> &laws,
                                      const SaddlePoint &start, StepOutcome &outcome) {
  for (AugmentedLagrangian &law : laws)
    law.friction = {contact::Tresca{std::numeric_limits<double>::max()}, law.friction.held()};
  find(time, data, start, outcome);
}

// What the last tangent answers to what x leaves of the body's equations, over x. The residual is
// computed cell by cell, as the round-off of assembled entries would stay unseen otherwise.
template <int dim>
Accuracy MonolithicRoute<dim>::accuracy(std::span<const double> right_side,
                                        std::span<const double> state, const StepOutcome &outcome) {
  if (system_.factorisation().count() == 0)
    return accuracy_so_far();
  SaddlePoint residual{std::vector<double>(state.size()), VectorXd::Zero(x_.multipliers.size())};
  model_.cells.multiply(model_.step, state, residual.body);
  std::vector<double> b(right_side.begin(), right_side.end());
  exchange_.add_flows(outcome, b);
  for (std::size_t i = 0; i < state.size(); ++i)
    residual.body[i] -= b[i];
  for (std::size_t n = 0; n < model_.interface.size(); ++n)
    for (int c = 0; c < dim; ++c)
      residual.body[body::unknown<dim>(model_.interface[n].node, c)] -=
          outcome.contact_forces[dim * static_cast<Index>(n) + c];
  return {so_far_.backward_error,
          body::relative_size<dim>(model_.sharing(), system_.increment(residual).body, state,
                                   system_.field_scales())};
}

template <int dim>
void MonolithicRoute<dim>::give_up(double time, const SaddleNewton<dim> &newton) const {
  const Verdict verdict = newton.verdict();
  const double tolerance = model_.asked.solver.tolerance;
  std::vector<Vector3> unsettled;
  for (std::size_t p = 0; p < system_.points().size(); ++p)
    if (!(newton.law_residual(p) <= tolerance * verdict.force_size))
      unsettled.push_back(system_.points()[p].place);
  std::string places;
  if (!unsettled.empty())
    places =
        fmt::format("; {} contact points are unsettled, among them{}", unsettled.size(),
                    first_places(unsettled.size(), [&](std::size_t i) { return unsettled[i]; }));
  throw UnsettledStep(fmt::format(
      "Newton's method did not converge at t = {:g} s: after {} iterations {} is left with a "
      "residual of {:.3g} of its own size, wanted {:.3g}{}; raise solver.max_iterations or "
      "solver.tolerance, take smaller time steps, leave solver.r_normal and solver.r_tangential "
      "at their defaults, or use solver.method = \"condensed\"",
      time, newton.iterations(), verdict.worst_name(), verdict.worst(), tolerance, places));
}

template <int dim>
void MonolithicRoute<dim>::describe(RouteReport &report) const {
  add_factorisation(system_.factorisation().statistics(), report);
  report.factorisations += system_.factorisation().count();
  report.substitution_seconds += system_.substitution_seconds();
  report.unknowns = system_.n_variables();
  report.electric_and_thermal_unknowns = system_.n_electric_and_thermal();
}

// The rest of x is the state.
template <int dim>
void MonolithicRoute<dim>::save_memory(output::SavedNumbers &numbers) const {
  numbers.put("multipliers", x_.multipliers);
  contact_.save(numbers);
  exchange_.save(numbers);
}

template <int dim>
void MonolithicRoute<dim>::restore_memory(const output::SavedNumbers &numbers) {
  numbers.fill("multipliers", x_.multipliers);
  contact_.restore(numbers);
  exchange_.restore(numbers);
}

}  // namespace

template <int dim>
std::unique_ptr<Route> monolithic_route(const Model<dim> &model) {
  return std::make_unique<MonolithicRoute<dim>>(model);
}

template std::unique_ptr<Route> monolithic_route<2>(const Model<2> &);
template std::unique_ptr<Route> monolithic_route<3>(const Model<3> &);

}  // namespace tourmaline::solve
