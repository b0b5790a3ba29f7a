#include "solve/active_set.h"

#include <algorithm>

#include "dense/decompositions.h"
#include "larger.h"

namespace tourmaline::solve {

using body::unknown;
using contact::Tangent;
using contact::TangentMatrix;
using Eigen::Index;
using Eigen::VectorXd;

template <int dim>
ActiveSet<dim>::ActiveSet(const Model<dim> &model, const std::vector<bool> &is_prescribed)
    : model_(model),
      is_prescribed_(is_prescribed),
      diagonal_(model.op.diagonal(model.step)),
      points_(model.interface.size()) {}

template <int dim>
std::size_t ActiveSet<dim>::first_unknown(std::size_t node) const {
  return unknown<dim>(model_.interface[node].node, 0);
}

template <int dim>
typename ActiveSet<dim>::Vector ActiveSet<dim>::at_node(std::span<const double> vector,
                                                        std::size_t node) const {
  return Vector::Map(&vector[first_unknown(node)]);
}

template <int dim>
void ActiveSet<dim>::begin_step(double time, std::span<const double> before,
                                std::span<const double> state) {
  Index offset = 0;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    Point &p = points_[i];
    p.admissible = contact::bilateral(model_.interface[i], is_prescribed_, state,
                                      model_.reach(model_.interface[i], time));
    p.offset = offset;
    offset += p.size();
    p.friction = {
        model_.friction(contact::contact_place(
            model_.interface[i].point, time, p.admissible.tangent(), model_.interface[i].contact)),
        p.admissible.held_slip(at_node(before, i))};
    p.slip_before = p.admissible.directions.transpose() * at_node(before, i);
    p.place = p.admissible.directions.transpose() * at_node(state, i);
    p.slip = p.admissible.directions.transpose() * (at_node(state, i) - at_node(before, i));
    p.slips =
        !p.is_held() && (!p.friction.has_kink(p.slip.size()) || (p.slips && p.slip.norm() > 0));
  }
}

template <int dim>
void ActiveSet<dim>::impose(std::span<double> state) const {
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const Point &p = points_[i];
    const Vector u =
        p.admissible.base + p.admissible.directions * (p.slips ? p.place : p.slip_before);
    std::copy(u.begin(), u.end(), &state[first_unknown(i)]);
  }
}

template <int dim>
void ActiveSet<dim>::read_slips(std::span<const double> state) {
  for (std::size_t i = 0; i < points_.size(); ++i) {
    Point &p = points_[i];
    if (!p.slips)
      continue;
    p.place = p.admissible.directions.transpose() * at_node(state, i);
    const Tangent slip = p.place - p.slip_before;
    if (p.friction.has_kink(slip.size()) && slip.dot(p.slip) <= 0)
      p.slips = false;
    p.slip = slip;
  }
}

template <int dim>
bool ActiveSet<dim>::change(std::span<const double> residual) {
  bool changed = false;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    Point &p = points_[i];
    if (p.is_held() || p.slips)
      continue;
    const double weight = model_.interface[i].weight;
    const Tangent lambda = slip_force(residual, i) / weight;
    const Tangent beyond = lambda - p.friction.traction(lambda, curvature(i) / weight);
    if (beyond.norm() <= 1e-12 * lambda.norm())
      continue;
    p.slips = changed = true;
    p.slip = beyond * (weight / curvature(i));
    p.place = p.slip_before + p.slip;
  }
  return changed;
}

template <int dim>
void ActiveSet<dim>::set_active(const std::vector<ContactStatus> &status) {
  for (std::size_t i = 0; i < points_.size(); ++i)
    points_[i].slips = !points_[i].is_held() && status[i] == ContactStatus::slip;
}

template <int dim>
Tangent ActiveSet<dim>::slip_force(std::span<const double> residual, std::size_t node) const {
  return points_[node].admissible.directions.transpose() * at_node(residual, node);
}

// Largest stiffness of the point's own block, by its trace [N/m].
template <int dim>
double ActiveSet<dim>::curvature(std::size_t node) const {
  double sum = 0;
  for (int c = 0; c < dim; ++c)
    sum += diagonal_[first_unknown(node) + c];
  return sum;
}

template <int dim>
Tangent ActiveSet<dim>::slip(std::size_t node) const {
  const Point &p = points_[node];
  return p.slips ? p.slip : Tangent(Tangent::Zero(p.slip.size()));
}

// lambda + r d [N/m^2].
template <int dim>
Tangent ActiveSet<dim>::trial(std::span<const double> residual, std::size_t node) const {
  return (slip_force(residual, node) + curvature(node) * slip(node)) /
         model_.interface[node].weight;
}

// |lambda - P(lambda + r d)| as a nodal force [N].
template <int dim>
double ActiveSet<dim>::residual_at(std::span<const double> residual, std::size_t node) const {
  const double weight = model_.interface[node].weight;
  const Tangent lambda =
      points_[node].friction.traction(trial(residual, node), curvature(node) / weight);
  return (slip_force(residual, node) - weight * lambda).norm();
}

template <int dim>
double ActiveSet<dim>::largest_residual(std::span<const double> residual) const {
  double worst = 0;
  for (std::size_t i = 0; i < points_.size(); ++i)
    worst = larger(worst, residual_at(residual, i));
  return worst;
}

template <int dim>
double ActiveSet<dim>::largest_force(std::span<const double> rows) const {
  double largest = 0;
  for (std::size_t i = 0; i < points_.size(); ++i)
    largest = larger(largest, at_node(rows, i).norm());
  return largest;
}

template <int dim>
double ActiveSet<dim>::force_size(std::span<const double> residual) const {
  return larger(1e-300, largest_force(residual));
}

template <int dim>
void ActiveSet<dim>::subtract_friction(std::span<double> rows) const {
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const Point &p = points_[i];
    if (!p.slips)
      continue;
    const Vector friction =
        model_.interface[i].weight * p.admissible.directions * p.friction.gradient(p.slip);
    for (int c = 0; c < dim; ++c)
      rows[first_unknown(i) + c] -= friction[c];
  }
}

template <int dim>
std::vector<krylov::NodeTangent<dim>> ActiveSet<dim>::held() const {
  std::vector<krylov::NodeTangent<dim>> held;
  for (const contact::InterfaceNode<dim> &at : model_.interface) {
    krylov::NodeTangent<dim> t{at.node, {}, {}};
    t.projector.setZero();
    t.stiffness.setZero();
    held.push_back(t);
  }
  return held;
}

template <int dim>
std::vector<krylov::NodeTangent<dim>> ActiveSet<dim>::tangents() const {
  std::vector<krylov::NodeTangent<dim>> tangents = held();
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const Point &p = points_[i];
    if (!p.slips)
      continue;
    const auto &d = p.admissible.directions;
    tangents[i].projector = d * d.transpose();
    tangents[i].stiffness =
        model_.interface[i].weight * d * p.friction.hessian(p.slip) * d.transpose();
  }
  return tangents;
}

template <int dim>
std::vector<ContactPoint> ActiveSet<dim>::programme_points() const {
  std::vector<ContactPoint> points;
  for (std::size_t i = 0; i < points_.size(); ++i)
    points.push_back(
        {points_[i].offset, points_[i].size(), model_.interface[i].weight, points_[i].friction});
  return points;
}

template <int dim>
std::vector<double> ActiveSet<dim>::curvatures() const {
  std::vector<double> curvatures;
  for (std::size_t i = 0; i < points_.size(); ++i)
    curvatures.push_back(curvature(i));
  return curvatures;
}

template <int dim>
VectorXd ActiveSet<dim>::increments() const {
  VectorXd d(points_.empty() ? 0 : points_.back().offset + points_.back().size());
  for (std::size_t i = 0; i < points_.size(); ++i)
    d.segment(points_[i].offset, points_[i].size()) = slip(i);
  return d;
}

template <int dim>
void ActiveSet<dim>::set_increments(const VectorXd &d) {
  for (Point &p : points_) {
    p.slip = d.segment(p.offset, p.size());
    p.place = p.slip_before + p.slip;
    p.slips = !p.is_held() && p.friction.is_smooth_at(p.slip);
  }
}

template <int dim>
VectorXd ActiveSet<dim>::components(std::span<const double> vector) const {
  std::vector<double> all;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const Tangent part = points_[i].admissible.directions.transpose() * at_node(vector, i);
    all.insert(all.end(), part.begin(), part.end());
  }
  return VectorXd::Map(all.data(), static_cast<Index>(all.size()));
}

template <int dim>
VectorXd ActiveSet<dim>::increments_of(std::span<const double> state) const {
  VectorXd d = components(state);
  for (const Point &p : points_)
    d.segment(p.offset, p.size()) -= p.slip_before;
  return d;
}

// Across a slip that is almost nothing friction is too stiff for the preconditioner: there the
// point is held.
template <int dim>
std::vector<krylov::NodeTangent<dim>> ActiveSet<dim>::tangents(
    const std::vector<bool> &is_smooth, const std::vector<TangentMatrix> &hessian) const {
  constexpr double too_stiff = 1e3;  // over the point's curvature
  std::vector<krylov::NodeTangent<dim>> tangents = held();
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (!is_smooth[i])
      continue;
    const auto &d = points_[i].admissible.directions;
    const auto modes = dense::spectrum(hessian[i]);
    for (Index k = 0; k < d.cols(); ++k) {
      if (modes.values[k] > too_stiff * curvature(i))
        continue;
      const Vector mode = d * modes.vectors.col(k);
      tangents[i].projector += mode * mode.transpose();
      tangents[i].stiffness += modes.values[k] * mode * mode.transpose();
    }
  }
  return tangents;
}

template <int dim>
void ActiveSet<dim>::put_forces(const std::vector<bool> &is_smooth, const VectorXd &components,
                                std::span<double> rows) const {
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (!is_smooth[i])
      continue;
    const Vector force =
        points_[i].admissible.directions * components.segment(points_[i].offset, points_[i].size());
    std::copy(force.begin(), force.end(), &rows[first_unknown(i)]);
  }
}

// Of the force q that holds a contact node friction is the law's; of the rest the foundation has
// what is normal, and supports have what is left in prescribed components.
template <int dim>
void ActiveSet<dim>::share_forces(std::span<const double> residual, std::size_t node,
                                  StepOutcome &outcome) const {
  const Point &p = points_[node];
  const double weight = model_.interface[node].weight, r = curvature(node) / weight;
  const auto &d = p.admissible.directions;
  const Tangent lambda = p.friction.traction(trial(residual, node), r);
  Vector q = -at_node(residual, node);
  q -= d * (d.transpose() * q + weight * lambda);
  const Tangent borne = -p.admissible.held.transpose() * q / weight;
  const Vector friction =
      -weight * p.admissible.tangent() * p.friction.whole_traction(slip(node), lambda, borne);
  const auto at = dim * static_cast<Index>(node);
  outcome.contact_forces.segment<dim>(at) = q - p.admissible.support(q, friction);
  outcome.friction_forces.segment<dim>(at) = friction;
  outcome.status.push_back(p.friction.status(trial(residual, node), r));
}

template <int dim>
StepOutcome ActiveSet<dim>::outcome(std::span<const double> residual) const {
  StepOutcome outcome;
  outcome.contact_forces = VectorXd::Zero(dim * static_cast<Index>(points_.size()));
  outcome.friction_forces = outcome.contact_forces;
  for (std::size_t i = 0; i < points_.size(); ++i)
    share_forces(residual, i, outcome);
  outcome.residual = relative_to(largest_residual(residual), force_size(residual));
  return outcome;
}

template <int dim>
void ActiveSet<dim>::save(output::SavedNumbers &numbers) const {
  std::vector<double> slips;
  for (const Point &p : points_)
    slips.push_back(p.slips);
  numbers.put("active set", slips);
}

template <int dim>
void ActiveSet<dim>::restore(const output::SavedNumbers &numbers) {
  const auto slips = numbers.get("active set", points_.size());
  for (std::size_t i = 0; i < points_.size(); ++i)
    points_[i].slips = slips[i] != 0;
}

template class ActiveSet<2>;
template class ActiveSet<3>;

}  // namespace tourmaline::solve
