#include "solve/contact_nodes.h"

#include <algorithm>
#include <cmath>

#include "solve/exchange_programme.h"

namespace tourmaline::solve {

using contact::Tangent;
using Eigen::Index;
using Eigen::VectorXd;

template <int dim>
ContactNodes<dim>::ContactNodes(const Model<dim> &model, const std::vector<bool> &is_prescribed)
    : model_(model), is_prescribed_(is_prescribed), step_(model), nodes_(model.interface.size()) {
  const std::vector<double> zero(model.n_unknowns(), 0.);
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    nodes_[i].admissible = contact::bilateral<dim>(model.interface[i], is_prescribed, zero);
    if (model.laws.of(model.interface[i]).has_normal_unknowns())
      add_normal(i, entries);
    add_slip(i, entries);
  }
  directions_.resize(dim * static_cast<Index>(nodes_.size()), n_);
  directions_.setFromTriplets(entries.begin(), entries.end());
}

// A bilateral point that is held by supports along its normal has its pressure from them, though
// nothing moves there. Of other laws the pressure is then known.
template <int dim>
void ContactNodes<dim>::add_normal(std::size_t i, std::vector<Eigen::Triplet<double>> &entries) {
  const contact::InterfaceNode<dim> &at = model_.interface[i];
  const bool is_known = nodes_[i].admissible.free_normal.isZero(0);
  contact::require_plain_normal(at, nodes_[i].admissible);
  if (is_known && model_.laws.of(at).can_open())
    return;
  nodes_[i].normal = points_.size();
  node_of_.push_back(i);
  points_.push_back({n_, 1, at.weight, {}});
  for (int c = 0; c < dim; ++c)
    entries.emplace_back(dim * static_cast<Index>(i) + c, n_, at.normal[c]);
  ++n_;
}

template <int dim>
void ContactNodes<dim>::add_slip(std::size_t i, std::vector<Eigen::Triplet<double>> &entries) {
  const auto &directions = nodes_[i].admissible.directions;
  nodes_[i].slip = points_.size();
  node_of_.push_back(i);
  points_.push_back({n_, directions.cols(), model_.interface[i].weight, {}});
  for (Index k = 0; k < directions.cols(); ++k)
    for (int c = 0; c < dim; ++c)
      entries.emplace_back(dim * static_cast<Index>(i) + c, n_ + k, directions(c, k));
  n_ += directions.cols();
  if (!model_.laws.of(model_.interface[i]).friction_depends_on_pressure())
    return;
  nodes_[i].coupling = couplings_.size();
  FrictionCoupling &coupling = couplings_.emplace_back();
  coupling.slip = nodes_[i].slip;
  if (nodes_[i].normal != none)
    coupling.normal = nodes_[i].normal;
}

template <int dim>
std::vector<Index> ContactNodes<dim>::movable() const {
  std::vector<Index> entries;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const Node &node = nodes_[i];
    if (node.normal != none && model_.laws.of(model_.interface[i]).can_open())
      entries.push_back(points_[node.normal].offset);
    for (Index k = 0; k < points_[node.slip].size; ++k)
      entries.push_back(points_[node.slip].offset + k);
  }
  return entries;
}

template <int dim>
void ContactNodes<dim>::begin_step(double time, std::span<const double> before,
                                   std::span<const double> state) {
  const std::span<const double> carried = model_.carried(before, time, carried_);
  step_.begin(time, before);
  from_.reset();  // of a step that failed
  for (ContactPoint &p : points_)
    p.start = Tangent(0);
  held_.resize(directions_.rows());
  last_.resize(directions_.rows());
  VectorXd c(directions_.rows());
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const contact::InterfaceNode<dim> &at = model_.interface[i];
    Node &node = nodes_[i];
    node.admissible.set_base(contact::prescribed_at(at, is_prescribed_, state),
                             model_.reach(at, time));
    held_.segment<dim>(dim * static_cast<Index>(i)) = node.admissible.base;
    c.segment<dim>(dim * static_cast<Index>(i)) = step_.displacement(carried, i);
    last_.segment<dim>(dim * static_cast<Index>(i)) = step_.displacement(before, i);
    if (node.normal != none)
      points_[node.normal].law = contact::NormalPoint(step_.normal(i));
    node.penetration = step_.penetration(i, node.admissible.base);
    set_friction(i, step_.displacement(carried, i));
    if (is_moved_along_normal(i))
      know_pressure(i);
  }
  stuck_ = directions_.transpose() * c;
  start_ = directions_.transpose() * (last_ - c);
  const VectorXd above = directions_.transpose() * (last_ - held_);
  for (const Node &node : nodes_)
    if (node.normal != none) {
      const Index n = points_[node.normal].offset;
      stuck_[n] = 0;
      start_[n] = above[n];
    }
}

template <int dim>
bool ContactNodes<dim>::loses_digits(const CoupledSolution &solution) const {
  constexpr double far_more = 4;
  double to_stick = 0;
  for (std::size_t i = 0; i < points_.size(); ++i)
    if (const ContactPoint &p = points_[i]; solution.interface.status[i] != ContactStatus::stick)
      to_stick = std::max(to_stick, start_.segment(p.offset, p.size).norm());
  return to_stick > 0 && to_stick > far_more * displacements(solution.interface.increment.head(n_))
                                                   .template lpNorm<Eigen::Infinity>();
}

// Whether the node is held in no direction.
template <int dim>
bool ContactNodes<dim>::is_free(std::size_t i, const CoupledSolution &solution) const {
  const std::vector<ContactStatus> &status = solution.interface.status;
  const Node &node = nodes_[i];
  return node.normal != none && 1 + points_[node.slip].size == dim &&
         status[node.normal] != ContactStatus::stick && status[node.slip] != ContactStatus::stick;
}

template <int dim>
void ContactNodes<dim>::measure_from_before(CoupledSolution &solution) {
  VectorXd from = stuck(), moved = VectorXd::Zero(n_);
  for (std::size_t i = 0; i < points_.size(); ++i)
    if (ContactPoint &p = points_[i]; solution.interface.status[i] != ContactStatus::stick) {
      const auto entries = Eigen::seqN(p.offset, p.size);
      p.start = moved(entries) = start_(entries);
      solution.interface.increment(entries) -= p.start;
    }
  // Of so small displacements the solution knows too little to start from; where nothing acts on
  // the body, this leaves it exactly where it is.
  const double nothing = 1e-10 * moved.lpNorm<Eigen::Infinity>();
  for (const ContactPoint &p : points_)
    if (auto y = solution.interface.increment.segment(p.offset, p.size); y.norm() <= nothing)
      y.setZero();
  from += directions_ * moved;
  for (std::size_t i = 0; i < nodes_.size(); ++i)
    if (const auto rows = Eigen::seqN(dim * static_cast<Index>(i), dim); is_free(i, solution))
      from(rows) = last_(rows);
  from_ = std::move(from);
}

template <int dim>
void ContactNodes<dim>::measure_from_stuck(CoupledSolution &solution) {
  for (ContactPoint &p : points_)
    if (p.start.size() > 0) {
      solution.interface.increment.segment(p.offset, p.size) += p.start;
      p.start = Tangent(0);
    }
  from_.reset();
}

template <int dim>
void ContactNodes<dim>::set_friction(std::size_t i, const Vector &carried) {
  const contact::InterfaceNode<dim> &at = model_.interface[i];
  const Node &node = nodes_[i];
  points_[node.slip].law = step_.friction(at.point, at.contact, node.admissible.tangent(),
                                          node.admissible.held_slip(carried));
  if (node.coupling != none)
    couplings_[node.coupling].bound = step_.bound(i);
}

template <int dim>
void ContactNodes<dim>::know_pressure(std::size_t i) {
  Node &node = nodes_[i];
  node.pressure = step_.pressure_under_supports(i, node.penetration);
  node.is_closed = step_.is_closed_under_supports(i, node.penetration);
  if (node.coupling == none)
    return;
  couplings_[node.coupling].pressure = node.pressure;
  couplings_[node.coupling].is_closed = node.is_closed;
}

template <int dim>
ExchangePoint ContactNodes<dim>::seen_by_exchange(std::size_t node) const {
  ExchangePoint seen;
  seen.slip = nodes_[node].slip;
  if (nodes_[node].normal != none)
    seen.normal = nodes_[node].normal;
  seen.known.pressure = nodes_[node].pressure;
  seen.known.penetration = nodes_[node].penetration;
  return seen;
}

template <int dim>
contact::ContactState ContactNodes<dim>::state_for_exchange(std::size_t node,
                                                            const CoupledSolution &solution) const {
  return state_at(seen_by_exchange(node), points_, solution, couplings_);
}

template <int dim>
ContactStatus ContactNodes<dim>::status(std::size_t i, const CoupledSolution &solution) const {
  const Node &node = nodes_[i];
  const std::vector<ContactStatus> &status = solution.interface.status;
  const bool is_open = is_moved_along_normal(i)
                           ? !node.is_closed
                           : node.normal != none && status[node.normal] == ContactStatus::open;
  return is_open ? ContactStatus::open : status[node.slip];
}

template <int dim>
const contact::PointLaw &ContactNodes<dim>::friction(const Node &node,
                                                     const CoupledSolution &solution) const {
  return node.coupling == none ? points_[node.slip].law.friction()
                               : solution.friction[node.coupling];
}

// Of the force q that holds a node friction is the law's; of the rest the foundation has what is
// normal, and supports have what is left in prescribed components.
template <int dim>
void ContactNodes<dim>::share_force(std::size_t i, const CoupledSolution &solution,
                                    StepOutcome &outcome) const {
  const Node &node = nodes_[i];
  const ContactPoint &p = points_[node.slip];
  const contact::PointLaw &law = friction(node, solution);
  auto q = outcome.contact_forces.segment<dim>(dim * static_cast<Index>(i));
  const Tangent borne = -node.admissible.held.transpose() * q / p.weight;
  const Tangent lambda =
      law.whole_traction(solution.interface.increment.segment(p.offset, p.size),
                         solution.interface.force.segment(p.offset, p.size) / p.weight, borne);
  const Vector friction = -p.weight * node.admissible.tangent() * lambda;
  outcome.friction_forces.segment<dim>(dim * static_cast<Index>(i)) = friction;
  if (is_moved_along_normal(i))
    q = friction - p.weight * node.pressure * node.admissible.normal;
  else
    q -= node.admissible.support(q, friction);
}

template <int dim>
void ContactNodes<dim>::end_step(const CoupledSolution &solution, StepOutcome &outcome) {
  step_.end();
  outcome.stage = solution.stage;
  outcome.newton_iterations = solution.interface.iterations;
  outcome.residual = solution.interface.residual;
  outcome.contact_forces -=
      directions_ * (directions_.transpose() * outcome.contact_forces + solution.interface.force);
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    share_force(i, solution, outcome);
    outcome.status[i] = status(i, solution);
    const ContactPoint &p = points_[nodes_[i].slip];
    if (outcome.status[i] != ContactStatus::open)
      step_.add_slip(i, std::hypot(solution.interface.increment.segment(p.offset, p.size).norm(),
                                   p.law.held().norm()));
  }
  for (std::size_t i = 0; is_coupled() && i < nodes_.size(); ++i)
    outcome.friction_bound[static_cast<Index>(i)] =
        friction(nodes_[i], solution).bound().value_or(0);
  if (model_.laws.remembers_slip())
    outcome.accumulated_slip = step_.accumulated_slip();
}

template class ContactNodes<2>;
template class ContactNodes<3>;

}  // namespace tourmaline::solve
