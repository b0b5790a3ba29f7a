#include "solve/monolithic_route.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "body/backward_error.h"
#include "contact/bilateral.h"
#include "parallel/ranks.h"
#include "solve/first_places.h"
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
  if (!model.asked.contact)
    return {};
  const contact::IsPrescribed is_prescribed = body::mask_of(model.prescribed, model.n_unknowns());
  if (model.asked.solver.multiplier == "nodal")
    return contact::nodal_multipliers(model.interface, is_prescribed);
  if (parallel::n_ranks() > 1)
    throw CaseError(model.asked.source +
                    ": [solver] multiplier: \"piecewise-constant\" is not available on several MPI "
                    "ranks; start the program without mpirun, or take \"nodal\"");
  return contact::facet_multipliers(model.body, model.asked.contact->on, is_prescribed);
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

  std::vector<double> rest_at(double time) const;
  std::vector<AugmentedLagrangian> laws_at(double time, std::span<const double> before,
                                           std::span<const double> state,
                                           std::span<const double> rest) const;
  SaddlePoint prediction(std::span<const double> before, std::span<const double> state) const;
  std::vector<ContactStatus> status(const StepData &data) const;
  void settle(const StepData &data, const std::vector<ContactStatus> &status);
  VectorXd holding_forces(const StepData &data) const;
  contact::Tangent whole_friction(const StepData &data, std::size_t p,
                                  const VectorXd &holding) const;
  void share_forces(const StepData &data, StepOutcome &outcome) const;
  std::size_t interface_index(body::Node node) const;
  [[noreturn]] void give_up(double time, const SaddleNewton<dim> &newton) const;

  void describe(RouteReport &report) const override;
  void save_memory(output::SavedNumbers &numbers) const override;
  void restore_memory(const output::SavedNumbers &numbers) override;

  const Model<dim> &model_;
  SaddleSystem<dim> system_;
  double area_ = 0;  // of the contact boundary [m^(dim-1)]
  SaddlePoint x_;
};

template <int dim>
MonolithicRoute<dim>::MonolithicRoute(const Model<dim> &model)
    : model_(model),
      system_(model.op, model.step, model.prescribed, multiplier_points(model),
              model.asked.solver.threads) {
  x_.multipliers = VectorXd::Zero(static_cast<Index>(system_.n_multipliers()));
  for (const Point &point : system_.points())
    area_ += point.weight;
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
    law.friction = {model_.friction(contact::contact_place(point.place, time, point.tangent())),
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
  const std::vector<AugmentedLagrangian> laws = laws_at(time, carried, state, rest);
  const StepData data{right_side, carried, rest, laws};
  SaddleNewton<dim> newton(system_, data, prediction(before, state));
  if (!newton.solve({model_.asked.solver.tolerance, model_.asked.solver.max_iterations}))
    give_up(time, newton);
  x_ = newton.x();
  const Verdict verdict = newton.verdict();
  see_backward_error(verdict.body());
  StepOutcome outcome;
  outcome.newton_iterations = newton.iterations();
  outcome.residual = verdict.worst();
  outcome.status = status(data);
  if (model_.asked.solver.multiplier == "nodal")
    settle(data, outcome.status);
  share_forces(data, outcome);
  std::copy(x_.body.begin(), x_.body.end(), state.begin());
  if (outgrew_measured<dim>(state))
    see_forward_error(accuracy(right_side, state, outcome).forward_error);
  return outcome;
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

// A node slips when the multiplier's point does: itself, or any of the facets around it.
template <int dim>
std::vector<ContactStatus> MonolithicRoute<dim>::status(const StepData &data) const {
  std::vector<ContactStatus> status(model_.interface.size(), ContactStatus::stick);
  for (std::size_t p = 0; p < data.laws.size(); ++p)
    if (data.laws[p].status(system_.displacement(p, x_, data), system_.multiplier(p, x_)) ==
        ContactStatus::slip)
      for (const auto &share : system_.points()[p].mean)
        status[interface_index(share.node)] = ContactStatus::slip;
  return status;
}

// A node that the law or a condition holds is put exactly there, not where the round-off of the
// last increment has left it. For nodal multipliers, whose points are the interface nodes.
template <int dim>
void MonolithicRoute<dim>::settle(const StepData &data, const std::vector<ContactStatus> &status) {
  for (std::size_t p = 0; p < data.laws.size(); ++p) {
    Local off = system_.displacement(p, x_, data);
    if (status[p] == ContactStatus::slip)
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
void MonolithicRoute<dim>::share_forces(const StepData &data, StepOutcome &outcome) const {
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
}

template <int dim>
void MonolithicRoute<dim>::restore_memory(const output::SavedNumbers &numbers) {
  numbers.fill("multipliers", x_.multipliers);
}

}  // namespace

template <int dim>
std::unique_ptr<Route> monolithic_route(const Model<dim> &model) {
  return std::make_unique<MonolithicRoute<dim>>(model);
}

template std::unique_ptr<Route> monolithic_route<2>(const Model<2> &);
template std::unique_ptr<Route> monolithic_route<3>(const Model<3> &);

}  // namespace tourmaline::solve
