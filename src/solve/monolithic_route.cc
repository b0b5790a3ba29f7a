#include "solve/monolithic_route.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "body/backward_error.h"
#include "contact/bilateral.h"
#include "parallel/ranks.h"
#include "solve/first_places.h"
#include "solve/held_bounds.h"
#include "solve/saddle_newton.h"
#include "tourmaline/error.h"

namespace tourmaline::solve {

namespace {

using contact::AugmentedLagrangian;
using contact::Local;
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

 private:
  using Point = contact::MultiplierPoint<dim>;
  using Vector = Eigen::Matrix<double, dim, 1>;

  std::vector<double> rest_at(double time) const;
  void find(double time, const StepData &data, SaddlePoint start, StepOutcome &outcome);
  void find_with_bounds(double time, const StepData &data, std::vector<AugmentedLagrangian> &laws,
                        SaddlePoint start, StepOutcome &outcome);
  std::vector<HeldBounds::State> states(double time, const StepData &data) const;
  double supported_pressure(double time, std::size_t p, const VectorXd &holding) const;
  void end_friction(const StepData &data, StepOutcome &outcome);
  std::vector<AugmentedLagrangian> laws_at(double time, std::span<const double> before,
                                           std::span<const double> state,
                                           std::span<const double> rest) const;
  SaddlePoint prediction(std::span<const double> before, std::span<const double> state) const;
  bool touches(double time, const StepData &data, std::size_t p) const;
  std::vector<ContactStatus> status(double time, const StepData &data) const;
  std::vector<HeldBounds::State> first_states() const;
  Vector displacement(std::span<const double> state, std::size_t node) const;
  double penetration(double time, std::size_t node) const;
  void settle(const StepData &data, const std::vector<ContactStatus> &status);
  VectorXd holding_forces(const StepData &data) const;
  contact::Tangent whole_friction(const StepData &data, std::size_t p,
                                  const VectorXd &holding) const;
  void share_forces(double time, const StepData &data, StepOutcome &outcome) const;
  std::size_t interface_index(body::Node node) const;
  // Points are the interface nodes then.
  bool has_normal_laws() const { return model_.laws.has_normal_unknowns(); }
  [[noreturn]] void give_up(double time, const SaddleNewton<dim> &newton) const;

  void describe(RouteReport &report) const override;
  void save_memory(output::SavedNumbers &numbers) const override;
  void restore_memory(const output::SavedNumbers &numbers) override;

  const Model<dim> &model_;
  SaddleSystem<dim> system_;
  double area_ = 0;  // of the contact boundary [m^(dim-1)]
  SaddlePoint x_;
  VectorXd slipped_;  // accumulated slip by node [m]
  // Of the step at hand:
  std::span<const double> before_;
  double force_size_ = 0;  // [N]
};

template <int dim>
MonolithicRoute<dim>::MonolithicRoute(const Model<dim> &model)
    : model_(model),
      system_(model.op, model.step, model.prescribed, multiplier_points(model),
              model.asked.solver.threads) {
  x_.multipliers = VectorXd::Zero(static_cast<Index>(system_.n_multipliers()));
  for (const Point &point : system_.points())
    area_ += point.weight;
  slipped_ = VectorXd::Zero(static_cast<Index>(model.interface.size()));
  if (!has_normal_laws())
    return;
  const std::vector<bool> is_prescribed = body::mask_of(model.prescribed, model.n_unknowns());
  for (const contact::InterfaceNode<dim> &at : model.interface)
    if (model.laws.of(at).has_normal_unknowns())
      contact::require_plain_normal(
          at, contact::bilateral<dim>(at, is_prescribed, std::vector<double>(model.n_unknowns())));
}

// The contact nodes just touch the foundation.
template <int dim>
std::vector<double> MonolithicRoute<dim>::rest_at(double time) const {
  std::vector<double> rest(model_.n_unknowns(), 0.);
  for (const contact::InterfaceNode<dim> &at : model_.interface)
    for (int c = 0; c < dim; ++c)
      rest[body::unknown<dim>(at.node, c)] = model_.reach(at, time) * at.normal[c];
  return rest;
}

// r_nu and r = r_tau / k as given, or else the stiffness of a body as large as the contact
// boundary: that of a node at the point, E / h, times h / L. With the stiffness of the node itself
// a slip that turns back in the iteration jumps to the opposite slip, and Newton's method cycles
// more often.
template <int dim>
std::vector<AugmentedLagrangian> MonolithicRoute<dim>::laws_at(double time,
                                                               std::span<const double> before,
                                                               std::span<const double> state,
                                                               std::span<const double> rest) const {
  const casefile::SolverCase &solver = model_.asked.solver;
  std::vector<AugmentedLagrangian> laws;
  for (std::size_t p = 0; p < system_.points().size(); ++p) {
    const Point &point = system_.points()[p];
    const double r = system_.stiffness_at(p) * std::pow(point.weight / area_, 1. / (dim - 1));
    AugmentedLagrangian &law = laws.emplace_back();
    law.has_normal = point.has_normal;
    law.r_normal = solver.r_normal.value_or(r);
    law.r_slip = solver.r_tangential ? *solver.r_tangential / model_.step : r;
    if (point.has_normal && model_.laws[point.contact].can_open())
      law.normal = model_.laws[point.contact].normal(point.place, penetration(time, p));
    law.friction = {
        model_.friction(contact::contact_place(point.place, time, point.tangent(), point.contact)),
        point.held_slip(state, before, rest)};
  }
  return laws;
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
  const std::vector<double> rest = rest_at(time);
  before_ = before;
  std::vector<AugmentedLagrangian> laws = laws_at(time, carried, state, rest);
  const StepData data{right_side, carried, rest, laws};
  StepOutcome outcome;
  if (model_.laws.friction_depends_on_pressure())
    find_with_bounds(time, data, laws, prediction(before, state), outcome);
  else
    find(time, data, prediction(before, state), outcome);
  outcome.status = status(time, data);
  if (model_.asked.solver.multiplier == "nodal")
    settle(data, outcome.status);
  share_forces(time, data, outcome);
  end_friction(data, outcome);
  std::copy(x_.body.begin(), x_.body.end(), state.begin());
  if (outgrew_measured<dim>(state))
    see_forward_error(accuracy(right_side, state, outcome).forward_error);
  return outcome;
}

template <int dim>
void MonolithicRoute<dim>::find(double time, const StepData &data, SaddlePoint start,
                                StepOutcome &outcome) {
  SaddleNewton<dim> newton(system_, data, std::move(start));
  if (!newton.solve({model_.asked.solver.tolerance, model_.asked.solver.max_iterations}))
    give_up(time, newton);
  x_ = newton.x();
  const Verdict verdict = newton.verdict();
  see_backward_error(verdict.body());
  outcome.newton_iterations += newton.iterations();
  outcome.residual = verdict.worst();
  force_size_ = verdict.force_size;
}

// `laws` are those of `data`: friction is held, the step solved, and so on.
template <int dim>
void MonolithicRoute<dim>::find_with_bounds(double time, const StepData &data,
                                            std::vector<AugmentedLagrangian> &laws,
                                            SaddlePoint start, StepOutcome &outcome) {
  constexpr int most = 200;
  std::vector<contact::PointLaw> own;
  std::vector<std::shared_ptr<const contact::FrictionBound>> bounds;
  double least_weight = std::numeric_limits<double>::infinity();
  for (std::size_t p = 0; p < laws.size(); ++p) {
    const Point &point = system_.points()[p];
    own.push_back(laws[p].friction);
    bounds.push_back(
        model_.laws[point.contact].bound(point.place, time, slipped_[static_cast<Index>(p)]));
    least_weight = std::min(least_weight, point.weight);
  }
  HeldBounds held(std::move(bounds), first_states());
  for (int k = 0; k < most; ++k) {
    for (std::size_t p = 0; p < laws.size(); ++p)
      laws[p].friction = held.law(p, own[p]);
    find(time, data, start, outcome);
    start = x_;
    if (held.settle(states(time, data),
                    model_.asked.solver.tolerance * force_size_ / least_weight)) {
      outcome.stage = ContactStage::fixed_point;
      outcome.friction_bound = VectorXd::Zero(static_cast<Index>(laws.size()));
      for (std::size_t p = 0; p < laws.size(); ++p)
        if (const auto *ball = std::get_if<contact::Tresca>(&laws[p].friction.law()))
          outcome.friction_bound[static_cast<Index>(p)] = ball->bound;
      return;
    }
  }
  throw SolveError(fmt::format(
      "the friction bounds, which follow the pressure, did not settle at t = {:g} s in {} rounds; "
      "take smaller time steps, or solver.method = \"condensed\"",
      time, most));
}

// As the last step left them.
template <int dim>
std::vector<HeldBounds::State> MonolithicRoute<dim>::first_states() const {
  std::vector<HeldBounds::State> all;
  for (std::size_t p = 0; p < system_.points().size(); ++p) {
    HeldBounds::State &state = all.emplace_back();
    if (system_.points()[p].has_normal)
      state.pressure = system_.multiplier(p, x_)[0];
    // Where friction does not depend on the pressure, bilateral contact that is pulled has it too.
    const contact::ContactLaws &laws = model_.laws[system_.points()[p].contact];
    state.is_closed = state.pressure >= 0 || !laws.has_normal_unknowns();
  }
  return all;
}

template <int dim>
std::vector<HeldBounds::State> MonolithicRoute<dim>::states(double time,
                                                            const StepData &data) const {
  const VectorXd holding = holding_forces(data);
  std::vector<HeldBounds::State> all;
  for (std::size_t p = 0; p < data.laws.size(); ++p) {
    const Point &point = system_.points()[p];
    const AugmentedLagrangian &law = data.laws[p];
    const Local y = system_.displacement(p, x_, data), lambda = system_.multiplier(p, x_);
    HeldBounds::State &state = all.emplace_back();
    state.slip =
        law.status(y, lambda) == ContactStatus::stick
            ? 0
            : std::hypot(y.tail(y.size() - point.has_normal).norm(), law.friction.held().norm());
    state.pressure =
        point.has_normal ? law.pressure(y, lambda) : supported_pressure(time, p, holding);
    state.is_closed = point.has_normal
                          ? law.is_closed(y, lambda)
                          : !model_.laws[point.contact].can_open() || state.pressure > 0;
  }
  return all;
}

// Of a node that supports hold along its normal.
template <int dim>
double MonolithicRoute<dim>::supported_pressure(double time, std::size_t p,
                                                const VectorXd &holding) const {
  const contact::InterfaceNode<dim> &at = model_.interface[p];
  if (!model_.laws.of(at).can_open())
    return -holding.template segment<dim>(dim * static_cast<Index>(p)).dot(at.normal) / at.weight;
  return model_.laws.of(at).pressure_under_supports(
      at.point, penetration(time, p),
      displacement(x_.body, p).dot(at.normal) - model_.reach(at, time));
}

template <int dim>
typename MonolithicRoute<dim>::Vector MonolithicRoute<dim>::displacement(
    std::span<const double> state, std::size_t node) const {
  return Vector::Map(&state[body::unknown<dim>(model_.interface[node].node, 0)]);
}

// At the end of the last step.
template <int dim>
double MonolithicRoute<dim>::penetration(double time, std::size_t node) const {
  const contact::InterfaceNode<dim> &at = model_.interface[node];
  return displacement(before_, node).dot(at.normal) - model_.reach(at, model_.time_before(time));
}

// What the next step's friction depends on.
template <int dim>
void MonolithicRoute<dim>::end_friction(const StepData &data, StepOutcome &outcome) {
  if (!has_normal_laws())
    return;
  for (std::size_t p = 0; p < data.laws.size(); ++p) {
    if (outcome.status[p] != ContactStatus::slip)
      continue;
    const Local y = system_.displacement(p, x_, data);
    slipped_[static_cast<Index>(p)] +=
        std::hypot(y.tail(y.size() - system_.points()[p].has_normal).norm(),
                   data.laws[p].friction.held().norm());
  }
  if (model_.laws.remembers_slip())
    outcome.accumulated_slip = slipped_;
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
  for (std::size_t i = 0; i < state.size(); ++i)
    residual.body[i] -= right_side[i];
  for (std::size_t n = 0; n < model_.interface.size(); ++n)
    for (int c = 0; c < dim; ++c)
      residual.body[body::unknown<dim>(model_.interface[n].node, c)] -=
          outcome.contact_forces[dim * static_cast<Index>(n) + c];
  return {so_far_.backward_error, body::relative_size<dim>(system_.increment(residual).body, state,
                                                           system_.field_scales())};
}

// A node slips when the multiplier's point does: itself, or any of the facets around it. Points of
// laws that open are the nodes.
template <int dim>
bool MonolithicRoute<dim>::touches(double time, const StepData &data, std::size_t p) const {
  return system_.points()[p].has_normal
             ? data.laws[p].is_closed(system_.displacement(p, x_, data), system_.multiplier(p, x_))
             : supported_pressure(time, p, {}) > 0;
}

template <int dim>
std::vector<ContactStatus> MonolithicRoute<dim>::status(double time, const StepData &data) const {
  std::vector<ContactStatus> status(model_.interface.size(), ContactStatus::stick);
  for (std::size_t p = 0; p < data.laws.size(); ++p)
    if (data.laws[p].status(system_.displacement(p, x_, data), system_.multiplier(p, x_)) ==
        ContactStatus::slip)
      for (const auto &share : system_.points()[p].mean)
        status[interface_index(share.node)] = ContactStatus::slip;
  for (std::size_t p = 0; model_.laws.can_open() && p < data.laws.size(); ++p)
    if (model_.laws[system_.points()[p].contact].can_open() && !touches(time, data, p))
      status[p] = ContactStatus::open;
  return status;
}

// A node that the law or a condition holds is put exactly there, not where the round-off of the
// last increment has left it. For nodal multipliers, whose points are the interface nodes.
template <int dim>
void MonolithicRoute<dim>::settle(const StepData &data, const std::vector<ContactStatus> &status) {
  for (std::size_t p = 0; p < data.laws.size(); ++p) {
    Local off = system_.displacement(p, x_, data);
    const auto &normal = data.laws[p].normal;
    if (normal && (status[p] == ContactStatus::open || !normal->has_kink()))
      off[0] = 0;
    if (status[p] != ContactStatus::stick)
      off.tail(off.size() - (data.laws[p].has_normal ? 1 : 0)).setZero();
    const typename Point::Vector correction = system_.points()[p].directions * off;
    for (int c = 0; c < dim; ++c) {
      const std::size_t i = body::unknown<dim>(model_.interface[p].node, c);
      if (system_.is_free(i))
        x_.body[i] -= correction[c];
    }
  }
}

// Nodal forces that hold the contact nodes: in free components those of the multipliers, -w
// (dy/du)^T (lambda_nu, P(lambda_tau + r d)), in prescribed ones the reaction.
template <int dim>
VectorXd MonolithicRoute<dim>::holding_forces(const StepData &data) const {
  VectorXd forces = VectorXd::Zero(dim * static_cast<Index>(model_.interface.size()));
  for (std::size_t p = 0; p < data.laws.size(); ++p) {
    const Point &point = system_.points()[p];
    const Local traction =
        data.laws[p]
            .gradient(system_.displacement(p, x_, data), system_.multiplier(p, x_))
            .traction;
    for (const auto &share : point.mean)
      forces.template segment<dim>(dim * static_cast<Index>(interface_index(share.node))) -=
          point.weight * share.factor * point.directions * traction;
  }
  for (std::size_t n = 0; n < model_.interface.size(); ++n)
    for (int c = 0; c < dim; ++c) {
      const std::size_t i = body::unknown<dim>(model_.interface[n].node, c);
      if (!system_.is_free(i))
        forces[dim * static_cast<Index>(n) + c] =
            model_.op.row_times(i, model_.step, x_.body) - data.right_side[i];
    }
  return forces;
}

// The law's lambda at a point in all its components. Along directions that are held at rest the
// contact would bear, if nothing else held the nodes, the mean of their `holding` forces.
template <int dim>
contact::Tangent MonolithicRoute<dim>::whole_friction(const StepData &data, std::size_t p,
                                                      const VectorXd &holding) const {
  const Point &point = system_.points()[p];
  const AugmentedLagrangian &law = data.laws[p];
  const Local y = system_.displacement(p, x_, data), lambda = system_.multiplier(p, x_);
  contact::Tangent slip = y.tail(y.size() - point.has_normal);
  if (law.status(y, lambda) == ContactStatus::stick)
    slip.setZero();
  typename Point::Vector borne = Point::Vector::Zero();
  for (const auto &share : point.mean) {
    const std::size_t n = interface_index(share.node);
    borne -= share.factor / model_.interface[n].weight *
             holding.template segment<dim>(dim * static_cast<Index>(n));
  }
  return law.friction.whole_traction(slip, law.friction_traction(y, lambda),
                                     point.held.transpose() * borne);
}

// As in `CondensedRoute`: friction is the law's, the foundation has what is normal, supports have
// the rest.
template <int dim>
void MonolithicRoute<dim>::share_forces(double time, const StepData &data,
                                        StepOutcome &outcome) const {
  outcome.contact_forces = holding_forces(data);
  outcome.friction_forces = VectorXd::Zero(outcome.contact_forces.size());
  for (std::size_t p = 0; p < data.laws.size(); ++p) {
    const Point &point = system_.points()[p];
    const typename Point::Vector traction =
        point.tangent() * whole_friction(data, p, outcome.contact_forces);
    for (const auto &share : point.mean)
      outcome.friction_forces.template segment<dim>(
          dim * static_cast<Index>(interface_index(share.node))) -=
          point.weight * share.factor * traction;
  }
  for (std::size_t n = 0; n < model_.interface.size(); ++n) {
    std::array<std::optional<double>, dim> prescribed;
    for (int c = 0; c < dim; ++c)
      if (!system_.is_free(body::unknown<dim>(model_.interface[n].node, c)))
        prescribed[c] = 0.;
    auto q = outcome.contact_forces.template segment<dim>(dim * static_cast<Index>(n));
    if (model_.laws.of(model_.interface[n]).can_open() && !system_.points()[n].has_normal) {
      q = outcome.friction_forces.template segment<dim>(dim * static_cast<Index>(n)) -
          model_.interface[n].weight * supported_pressure(time, n, {}) * model_.interface[n].normal;
      continue;
    }
    q -=
        contact::bilateral<dim>(model_.interface[n].normal, prescribed)
            .support(q, outcome.friction_forces.template segment<dim>(dim * static_cast<Index>(n)));
  }
}

template <int dim>
std::size_t MonolithicRoute<dim>::interface_index(body::Node node) const {
  const auto found =
      std::lower_bound(model_.interface.begin(), model_.interface.end(), node,
                       [](const auto &at, body::Node wanted) { return at.node < wanted; });
  return found - model_.interface.begin();
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
  throw SolveError(fmt::format(
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
  if (model_.laws.remembers_slip())
    numbers.put("accumulated slip", slipped_);
}

template <int dim>
void MonolithicRoute<dim>::restore_memory(const output::SavedNumbers &numbers) {
  numbers.fill("multipliers", x_.multipliers);
  if (model_.laws.remembers_slip())
    numbers.fill("accumulated slip", slipped_);
}

}  // namespace

template <int dim>
std::unique_ptr<Route> monolithic_route(const Model<dim> &model) {
  return std::make_unique<MonolithicRoute<dim>>(model);
}

template std::unique_ptr<Route> monolithic_route<2>(const Model<2> &);
template std::unique_ptr<Route> monolithic_route<3>(const Model<3> &);

}  // namespace tourmaline::solve
