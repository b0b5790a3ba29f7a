#include "solve/saddle_contact.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "contact/bilateral.h"

namespace tourmaline::solve {

using contact::AugmentedLagrangian;
using contact::Local;
using Eigen::Index;
using Eigen::VectorXd;

template <int dim>
SaddleContact<dim>::SaddleContact(const Model<dim> &model, const SaddleSystem<dim> &system)
    : model_(model), system_(system), step_(model) {
  for (const Point &point : system_.points())
    area_ += point.weight;
  if (!model_.laws.has_normal_unknowns())
    return;
  const std::vector<bool> is_prescribed = body::mask_of(model.prescribed, model.n_unknowns());
  for (const contact::InterfaceNode<dim> &at : model.interface)
    if (model.laws.of(at).has_normal_unknowns())
      contact::require_plain_normal(
          at, contact::bilateral<dim>(at, is_prescribed, std::vector<double>(model.n_unknowns())));
}

// The contact nodes just touch the foundation.
template <int dim>
std::vector<double> SaddleContact<dim>::rest() const {
  std::vector<double> rest(model_.n_unknowns(), 0.);
  for (const contact::InterfaceNode<dim> &at : model_.interface)
    for (int c = 0; c < dim; ++c)
      rest[body::unknown<dim>(at.node, c)] = model_.reach(at, time_) * at.normal[c];
  return rest;
}

// r_nu and r = r_tau / k as given, or else the stiffness of a body as large as the contact
// boundary: that of a node at the point, E / h, times h / L. With the stiffness of the node itself
// a slip that turns back in the iteration jumps to the opposite slip, and Newton's method cycles
// more often.
template <int dim>
std::vector<AugmentedLagrangian> SaddleContact<dim>::laws(std::span<const double> before,
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
      law.normal = step_.normal(p);
    law.friction = step_.friction(point.place, point.contact, point.tangent(),
                                  point.held_slip(state, before, rest));
  }
  return laws;
}

template <int dim>
std::vector<std::shared_ptr<const contact::FrictionBound>> SaddleContact<dim>::bounds() const {
  std::vector<std::shared_ptr<const contact::FrictionBound>> bounds;
  for (std::size_t p = 0; p < system_.points().size(); ++p)
    bounds.push_back(step_.bound(p));
  return bounds;
}

// As the last step left them.
template <int dim>
std::vector<HeldBounds::State> SaddleContact<dim>::first_states(const SaddlePoint &x) const {
  std::vector<HeldBounds::State> all;
  for (std::size_t p = 0; p < system_.points().size(); ++p) {
    HeldBounds::State &state = all.emplace_back();
    if (system_.points()[p].has_normal)
      state.pressure = system_.multiplier(p, x)[0];
    // Where friction does not depend on the pressure, bilateral contact that is pulled has it too.
    const contact::ContactLaws &laws = model_.laws[system_.points()[p].contact];
    state.is_closed = state.pressure >= 0 || !laws.has_normal_unknowns();
  }
  return all;
}

template <int dim>
std::vector<HeldBounds::State> SaddleContact<dim>::states(const StepData &data,
                                                          const SaddlePoint &x) const {
  const VectorXd holding = holding_forces(data, x);
  std::vector<HeldBounds::State> all;
  for (std::size_t p = 0; p < data.laws.size(); ++p) {
    const Point &point = system_.points()[p];
    const AugmentedLagrangian &law = data.laws[p];
    const Local y = system_.displacement(p, x, data), lambda = system_.multiplier(p, x);
    HeldBounds::State &state = all.emplace_back();
    state.slip =
        law.status(y, lambda) == ContactStatus::stick
            ? 0
            : std::hypot(y.tail(y.size() - point.has_normal).norm(), law.friction.held().norm());
    state.pressure = point.has_normal ? law.pressure(y, lambda) : supported_pressure(x, p, holding);
    state.is_closed = !model_.laws[point.contact].can_open() || touches(data, x, p);
    if (point.has_normal && !state.is_closed)
      state.opening = -law.normal_trial(y, lambda);
    state.friction = law.friction_traction(y, lambda).norm();
  }
  return all;
}

template <int dim>
std::vector<contact::ContactState> SaddleContact<dim>::states_for_exchange(
    const StepData &data, const SaddlePoint &x) const {
  const std::vector<HeldBounds::State> found = states(data, x);
  std::vector<contact::ContactState> all;
  for (std::size_t p = 0; p < found.size(); ++p) {
    const AugmentedLagrangian &law = data.laws[p];
    const Local y = system_.displacement(p, x, data);
    contact::Tangent slip = y.tail(y.size() - system_.points()[p].has_normal);
    if (found[p].slip == 0)
      slip.setZero();
    all.push_back({found[p].pressure, penetration(x, p), law.friction.dissipation(slip)});
  }
  return all;
}

template <int dim>
std::vector<ContactStatus> SaddleContact<dim>::status(const StepData &data,
                                                      const SaddlePoint &x) const {
  std::vector<ContactStatus> status(model_.interface.size(), ContactStatus::stick);
  for (std::size_t p = 0; p < data.laws.size(); ++p)
    if (data.laws[p].status(system_.displacement(p, x, data), system_.multiplier(p, x)) ==
        ContactStatus::slip)
      for (const auto &share : system_.points()[p].mean)
        status[interface_index(share.node)] = ContactStatus::slip;
  for (std::size_t p = 0; model_.laws.can_open() && p < data.laws.size(); ++p)
    if (model_.laws[system_.points()[p].contact].can_open() && !touches(data, x, p))
      status[p] = ContactStatus::open;
  return status;
}

// A node slips when the multiplier's point does: itself, or any of the facets around it. Points of
// laws that open are the nodes.
template <int dim>
bool SaddleContact<dim>::touches(const StepData &data, const SaddlePoint &x, std::size_t p) const {
  if (!just_touches_.empty() && just_touches_[p])
    return true;
  if (system_.points()[p].has_normal)
    return data.laws[p].is_closed(system_.displacement(p, x, data), system_.multiplier(p, x));
  return step_.is_closed_under_supports(p, penetration(x, p));
}

// Of a node that supports hold along its normal.
template <int dim>
double SaddleContact<dim>::supported_pressure(const SaddlePoint &x, std::size_t p,
                                              const VectorXd &holding) const {
  const contact::InterfaceNode<dim> &at = model_.interface[p];
  if (!model_.laws.of(at).can_open())
    return -holding.template segment<dim>(dim * static_cast<Index>(p)).dot(at.normal) / at.weight;
  return step_.pressure_under_supports(p, penetration(x, p));
}

// A node that the law or a condition holds is put exactly there, not where the round-off of the
// last increment has left it. For nodal multipliers, whose points are the interface nodes.
template <int dim>
void SaddleContact<dim>::settle(const StepData &data, const std::vector<ContactStatus> &status,
                                SaddlePoint &x) const {
  for (std::size_t p = 0; p < data.laws.size(); ++p) {
    Local off = system_.displacement(p, x, data);
    const auto &normal = data.laws[p].normal;
    if (normal && (status[p] == ContactStatus::open || !normal->has_kink()))
      off[0] = 0;
    if (status[p] != ContactStatus::stick)
      off.tail(off.size() - (data.laws[p].has_normal ? 1 : 0)).setZero();
    const typename Point::Vector correction = system_.points()[p].directions * off;
    for (int c = 0; c < dim; ++c) {
      const std::size_t i = body::unknown<dim>(model_.interface[p].node, c);
      if (system_.is_free(i))
        x.body[i] -= correction[c];
    }
  }
}

// As in `CondensedRoute`: friction is the law's, the foundation has what is normal, supports have
// the rest.
template <int dim>
void SaddleContact<dim>::share_forces(const StepData &data, const SaddlePoint &x,
                                      StepOutcome &outcome) const {
  outcome.contact_forces = holding_forces(data, x);
  outcome.friction_forces = VectorXd::Zero(outcome.contact_forces.size());
  for (std::size_t p = 0; p < data.laws.size(); ++p) {
    const Point &point = system_.points()[p];
    const typename Point::Vector traction =
        point.tangent() * whole_friction(data, x, p, outcome.contact_forces);
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
          model_.interface[n].weight * supported_pressure(x, n, {}) * model_.interface[n].normal;
      continue;
    }
    q -=
        contact::bilateral<dim>(model_.interface[n].normal, prescribed)
            .support(q, outcome.friction_forces.template segment<dim>(dim * static_cast<Index>(n)));
  }
}

// The law's lambda at a point in all its components. Along directions that are held at rest the
// contact would bear, if nothing else held the nodes, the mean of their `holding` forces.
template <int dim>
contact::Tangent SaddleContact<dim>::whole_friction(const StepData &data, const SaddlePoint &x,
                                                    std::size_t p, const VectorXd &holding) const {
  const Point &point = system_.points()[p];
  const AugmentedLagrangian &law = data.laws[p];
  const Local y = system_.displacement(p, x, data), lambda = system_.multiplier(p, x);
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

// Nodal forces that hold the contact nodes: in free components those of the multipliers, -w
// (dy/du)^T (lambda_nu, P(lambda_tau + r d)), in prescribed ones the reaction.
template <int dim>
VectorXd SaddleContact<dim>::holding_forces(const StepData &data, const SaddlePoint &x) const {
  VectorXd forces = VectorXd::Zero(dim * static_cast<Index>(model_.interface.size()));
  for (std::size_t p = 0; p < data.laws.size(); ++p) {
    const Point &point = system_.points()[p];
    const Local traction =
        data.laws[p].gradient(system_.displacement(p, x, data), system_.multiplier(p, x)).traction;
    for (const auto &share : point.mean)
      forces.template segment<dim>(dim * static_cast<Index>(interface_index(share.node))) -=
          point.weight * share.factor * point.directions * traction;
  }
  for (std::size_t n = 0; n < model_.interface.size(); ++n)
    for (int c = 0; c < dim; ++c) {
      const std::size_t i = body::unknown<dim>(model_.interface[n].node, c);
      if (!system_.is_free(i))
        forces[dim * static_cast<Index>(n) + c] =
            model_.op.row_times(i, model_.step, x.body) - data.right_side[i];
    }
  return forces;
}

// What the next step's friction depends on.
template <int dim>
void SaddleContact<dim>::end_step(const StepData &data, const SaddlePoint &x,
                                  StepOutcome &outcome) {
  if (!model_.laws.has_normal_unknowns())
    return;
  step_.end();
  for (std::size_t p = 0; p < data.laws.size(); ++p) {
    if (outcome.status[p] != ContactStatus::slip)
      continue;
    const Local y = system_.displacement(p, x, data);
    step_.add_slip(p, std::hypot(y.tail(y.size() - system_.points()[p].has_normal).norm(),
                                 data.laws[p].friction.held().norm()));
  }
  if (model_.laws.remembers_slip())
    outcome.accumulated_slip = step_.accumulated_slip();
}

template <int dim>
std::size_t SaddleContact<dim>::interface_index(body::Node node) const {
  const auto found =
      std::lower_bound(model_.interface.begin(), model_.interface.end(), node,
                       [](const auto &at, body::Node wanted) { return at.node < wanted; });
  return found - model_.interface.begin();
}

template class SaddleContact<2>;
template class SaddleContact<3>;

}  // namespace tourmaline::solve
