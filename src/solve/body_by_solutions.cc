#include "solve/body_by_solutions.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <utility>

#include "dense/decompositions.h"
#include "larger.h"

namespace tourmaline::solve {

using contact::TangentMatrix;
using Eigen::Index;
using Eigen::VectorXd;

namespace {

constexpr double slightly = 1e-8;  // of the stiffness of the contact's points

}  // namespace

template <int dim>
BodyBySolutions<dim>::BodyBySolutions(const Model<dim> &model,
                                      const std::vector<bool> &is_prescribed,
                                      BodyEquations<dim> &body, const ContactNodes<dim> &contact,
                                      bool is_leaning)
    : model_(model),
      is_prescribed_(is_prescribed),
      body_(body),
      contact_(contact),
      is_leaning_(is_leaning),
      stiffness_(contact.n_unknowns()) {
  const std::vector<double> diagonal = model.op.diagonal(model.step);
  for (std::size_t i = 0; i < contact_.points().size(); ++i) {
    const std::size_t first = body::unknown<dim>(model.interface[contact_.node_of(i)].node, 0);
    curvatures_.push_back(std::accumulate(&diagonal[first], &diagonal[first] + dim, 0.));
    stiffness_.segment(contact_.points()[i].offset, contact_.points()[i].size)
        .setConstant(curvatures_.back());
  }
}

template <int dim>
void BodyBySolutions<dim>::begin_step(double time, std::span<double> state, double tolerance) {
  time_ = time;
  tolerance_ = tolerance;
  state_ = state;
  iterations_ = 0;
  moved_.assign(state_.size(), 0.);
  put(possible(increments_of(state_)));
}

template <int dim>
void BodyBySolutions<dim>::begin_anew() {
  moved_.assign(state_.size(), 0.);
  is_solved_ = false;
}

template <int dim>
VectorXd BodyBySolutions<dim>::at_contact(std::span<const double> vector) const {
  VectorXd by_node(dim * static_cast<Index>(model_.interface.size()));
  for (std::size_t i = 0; i < model_.interface.size(); ++i)
    for (int c = 0; c < dim; ++c)
      by_node[dim * static_cast<Index>(i) + c] =
          vector[body::unknown<dim>(model_.interface[i].node, c)];
  return by_node;
}

template <int dim>
void BodyBySolutions<dim>::add_at_contact(const VectorXd &by_node, std::span<double> vector) const {
  for (std::size_t i = 0; i < model_.interface.size(); ++i)
    for (int c = 0; c < dim; ++c)
      vector[body::unknown<dim>(model_.interface[i].node, c)] +=
          by_node[dim * static_cast<Index>(i) + c];
}

template <int dim>
VectorXd BodyBySolutions<dim>::increments_of(std::span<const double> state) const {
  const VectorXd start = contact_.displacements(VectorXd::Zero(contact_.n_unknowns()));
  return contact_.directions().transpose() * (at_contact(state) - start);
}

// Nearby penetrations that the laws allow.
template <int dim>
VectorXd BodyBySolutions<dim>::possible(VectorXd d) const {
  for (const ContactPoint &p : contact_.points())
    if (!std::isfinite(p.law.potential(p.slip(d))))
      p.hold(d);
  return d;
}

template <int dim>
void BodyBySolutions<dim>::put(const VectorXd &d) {
  d_ = d;
  is_solved_ = false;
  const VectorXd c = contact_.displacements(d);
  for (std::size_t i = 0; i < model_.interface.size(); ++i)
    for (int k = 0; k < dim; ++k)
      if (const std::size_t u = body::unknown<dim>(model_.interface[i].node, k); !is_prescribed_[u])
        state_[u] = c[dim * static_cast<Index>(i) + k];
}

// Where there are no forces, as the body has left the foundation, round-off is what counts; and so
// does that of slips which are longer than the body deforms by many powers of ten.
template <int dim>
double BodyBySolutions<dim>::size_at_state() const {
  const auto [largest, round_off] = body_.nodal_forces();
  const double least = larger(round_off, body_.first_nodal_forces().round_off);
  const double size = larger(largest, larger(least, round_off_of_slips()) / tolerance_);
  return size == 0 ? 1 : size;
}

// Nodal forces that the last digit of the contact's unknowns is worth [N].
template <int dim>
double BodyBySolutions<dim>::round_off_of_slips() const {
  constexpr double last_digits = 16 * std::numeric_limits<double>::epsilon();
  double largest = 0;
  for (std::size_t i = 0; i < contact_.points().size(); ++i) {
    const ContactPoint &p = contact_.points()[i];
    largest = larger(largest, curvatures_[i] * d_.segment(p.offset, p.size).norm());
  }
  return last_digits * largest;
}

// What contact and prescribed unknowns leave free of a residual.
template <int dim>
std::vector<double> BodyBySolutions<dim>::freed(std::vector<double> residual) const {
  for (std::size_t i = 0; i < residual.size(); ++i)
    if (is_prescribed_[i])
      residual[i] = 0;
  for (const contact::InterfaceNode<dim> &at : model_.interface)
    std::fill_n(&residual[body::unknown<dim>(at.node, 0)], dim, 0.);
  return residual;
}

template <int dim>
NodeSystem<dim> BodyBySolutions<dim>::all_held() const {
  ContactTangent nothing;
  nothing.known = VectorXd::Zero(contact_.n_unknowns());
  return NodeSystem<dim>(contact_, model_, nothing);
}

template <int dim>
NaturalMap::Place BodyBySolutions<dim>::look() {
  body_.update_residual();
  size_ = size_at_state();
  return place(body_.residual());
}

template <int dim>
NaturalMap::Place BodyBySolutions<dim>::place(std::span<const double> residual) const {
  return {d_, contact_.directions().transpose() * at_contact(residual), {}};
}

template <int dim>
bool BodyBySolutions<dim>::is_within(const VectorXd &, double residual, double tolerance) const {
  return relative_to(residual, size_) <= tolerance;
}

// The linear system of Newton's method, and the right side of what is left when the contact nodes
// have `moved`: from nodal `force` [N] in its free directions, and from what the free unknowns
// beside it leave of their equations, `residual`. Mostly nothing has moved, which saves a product.
template <int dim>
std::vector<double> BodyBySolutions<dim>::set_system(const NodeSystem<dim> &system,
                                                     const VectorXd &moved, const VectorXd &force,
                                                     std::vector<double> residual) {
  VectorXd coupled = contact_.directions() * force;
  if (!moved.isZero(0))
    take_off(moved, system, coupled, residual);
  add_at_contact(coupled, residual);
  body_.system().set_contact(system.tangents);
  if (system.is_coupled())
    body_.system().set_coupling(system.couplings);
  body_.system().project(residual);
  return residual;
}

// What the body and the contact's tangents answer to nodes that have `moved`.
template <int dim>
void BodyBySolutions<dim>::take_off(const VectorXd &moved, const NodeSystem<dim> &system,
                                    VectorXd &coupled, std::vector<double> &residual) const {
  std::vector<double> whole(state_.size(), 0.);
  add_at_contact(moved, whole);
  const std::vector<double> resisted = product(whole);
  std::ranges::transform(residual, resisted, residual.begin(), std::minus<>());
  const VectorXd resisting = at_contact(resisted);
  for (std::size_t i = 0; i < system.couplings.size(); ++i) {
    const auto at = Eigen::seqN(dim * static_cast<Index>(i), dim);
    coupled(at) -= system.couplings[i].of_force * resisting(at) +
                   (system.couplings[i].of_displacement + system.tangents[i].stiffness) * moved(at);
  }
}

// Adds to the state the `known` increments of the contact and what follows from them and the rest.
template <int dim>
bool BodyBySolutions<dim>::correct(const NodeSystem<dim> &system, const VectorXd &known,
                                   const VectorXd &force, std::vector<double> residual,
                                   double reduction) {
  const VectorXd moved = contact_.directions() * known;
  const bool solved =
      body_.correct(set_system(system, moved, force, std::move(residual)), reduction);
  body_.system().set_coupling({});
  add_at_contact(moved, state_);
  return solved;
}

template <int dim>
double BodyBySolutions<dim>::forward_error(const ContactTangent &tangent,
                                           std::vector<double> residual) {
  const NodeSystem<dim> system(contact_, model_, with_springs(tangent));
  const VectorXd nothing = VectorXd::Zero(contact_.directions().rows());
  const double error =
      body_.forward_error(set_system(system, nothing, system.force, freed(std::move(residual))));
  body_.system().set_coupling({});
  return error;
}

template <int dim>
bool BodyBySolutions<dim>::newton_step(const ContactTangent &tangent, std::vector<double> residual,
                                       double reduction) {
  const NodeSystem<dim> system(contact_, model_, with_springs(tangent));
  if (iterations_++ == 0) {  // a step begins with the preconditioner of its own contact
    body_.system().set_contact(system.tangents);
    body_.system().refresh();
  }
  if (!correct(system, system.known, system.force, std::move(residual), reduction))
    return false;
  const VectorXd moved = contact_.directions().transpose() * at_contact(body_.increment());
  VectorXd next = d_ + system.known;
  for (const ContactTangent::Point &at : tangent.points) {
    const ContactPoint &p = contact_.points()[at.point];
    const auto own = Eigen::seqN(p.offset, p.size);
    next(own) += moved(own);
    // A slip that turns is caught.
    if (p.law.normal() == nullptr && p.law.held().isZero(0) && p.slip(next).dot(p.slip(d_)) < 0)
      p.hold(next);
  }
  put(next);
  return true;
}

// What the linear system answers; the state stays as it is.
template <int dim>
std::optional<ContactBody::Moved> BodyBySolutions<dim>::response(const NodeSystem<dim> &system,
                                                                 const VectorXd &known,
                                                                 const VectorXd &force,
                                                                 double reduction) {
  const VectorXd moved = contact_.directions() * known;
  const bool solved = body_.solve(
      set_system(system, moved, force, std::vector<double>(state_.size(), 0.)), reduction);
  body_.system().set_coupling({});
  moved_ = body_.increment();
  add_at_contact(moved, moved_);
  if (!solved)
    return std::nullopt;
  const auto transposed = contact_.directions().transpose();
  return Moved{transposed * at_contact(moved_), transposed * at_contact(product(moved_)), {}};
}

template <int dim>
std::optional<Eigen::MatrixXd> BodyBySolutions<dim>::matrix(
    const std::function<void(Index)> &made) {
  const Index n = contact_.n_unknowns();
  const NodeSystem<dim> system = all_held();
  body_.system().set_contact(system.tangents);
  body_.system().refresh();
  Eigen::MatrixXd matrix(n, n);
  for (Index k = 0; k < n; ++k) {
    ++iterations_;
    const auto moved = response(system, VectorXd::Unit(n, k), VectorXd::Zero(n), error_of_matrix);
    if (!moved)
      return std::nullopt;
    matrix.col(k) = moved->resisted;
    made(k + 1);
  }
  begin_anew();
  return (matrix + matrix.transpose()) / 2;
}

template <int dim>
std::optional<ContactBody::Moved> BodyBySolutions<dim>::solve(const ContactTangent &tangent) {
  constexpr double reduction = 1e-4;
  constexpr std::size_t most_shares = 20;
  if (tangent.shares.size() > most_shares)
    return std::nullopt;
  const ContactTangent sprung = with_springs(tangent);
  const NodeSystem<dim> system(contact_, model_, sprung);
  std::optional<Moved> moved = response(system, system.known, system.force, reduction);
  ++iterations_;
  if (moved && !add_shares(system, sprung, reduction, *moved))
    return std::nullopt;
  if (moved)
    moved->resisted += springs_ * stiffness_.cwiseProduct(moved->x);
  return moved;
}

// A with springs is A and a diagonal matrix. Where only the contact holds the body, A may be
// singular: then directions are found for slightly more than it.
template <int dim>
ContactTangent BodyBySolutions<dim>::with_springs(ContactTangent tangent) const {
  const double springs = springs_ + (is_leaning_ ? slightly : 0);
  if (springs == 0)
    return tangent;
  for (ContactTangent::Point &at : tangent.points) {
    const auto n = at.derivative.rows();
    at.of_own += springs * curvatures_[at.point] * (at.derivative - TangentMatrix::Identity(n, n));
    if (at.normal)
      at.of_normal += springs * curvatures_[*at.normal] * at.of_force;
  }
  for (ContactTangent::Share &share : tangent.shares)
    share.of_normal -= springs * curvatures_[share.normal];
  return tangent;
}

// They are few: what one unit of each does to the body, and then those that their equations want.
template <int dim>
bool BodyBySolutions<dim>::add_shares(const NodeSystem<dim> &system, const ContactTangent &tangent,
                                      double reduction, Moved &moved) {
  const auto n = static_cast<Index>(tangent.shares.size());
  moved.share = tangent.known_share;
  if (n == 0)
    return true;
  std::vector<Moved> units;
  for (Index k = 0; k < n; ++k) {
    const auto unit =
        response(system, VectorXd::Zero(moved.x.size()), system.of_share.col(k), reduction);
    if (!unit)
      return false;
    units.push_back(*unit);
  }
  Eigen::MatrixXd matrix(n, n);
  VectorXd right_side(n);
  for (Index row = 0; row < n; ++row) {
    const ContactTangent::Share &share = tangent.shares[static_cast<std::size_t>(row)];
    const Index normal = contact_.points()[share.normal].offset;
    const auto left = [&](const Moved &by) {
      return share.of_normal * by.x[normal] - by.resisted[normal];
    };
    for (Index k = 0; k < n; ++k)
      matrix(row, k) = left(units[static_cast<std::size_t>(k)]) + (k == row ? share.of_share : 0);
    right_side[row] = share.right_side - left(moved);
  }
  const VectorXd found = dense::solve(matrix, right_side);
  for (Index k = 0; k < n; ++k) {
    const auto at = static_cast<std::size_t>(k);
    moved.share[static_cast<Index>(tangent.shares[at].share)] = found[k];
    moved.x += found[k] * units[at].x;
    moved.resisted += found[k] * units[at].resisted;
  }
  return found.allFinite();
}

// The body starts where it would be if it moved with the contact as it did in the last linear
// solve, as far as the contact does.
template <int dim>
VectorXd BodyBySolutions<dim>::force(const VectorXd &d) {
  if (is_solved_ && d == d_)
    return force_ - springs_ * stiffness_.cwiseProduct(d);
  const VectorXd moved = contact_.directions().transpose() * at_contact(moved_);
  if (const double size = moved.squaredNorm(); size > 0) {
    const double share = moved.dot(d - d_) / size;
    for (std::size_t i = 0; i < state_.size(); ++i)
      state_[i] += share * moved_[i];
  }
  put(d);
  body_.solve_held(time_, held());
  size_ = size_at_state();
  is_solved_ = true;
  force_ = contact_.directions().transpose() * at_contact(body_.residual());
  return force_ - springs_ * stiffness_.cwiseProduct(d);
}

// Rows A x + H x = force of the points that are free, H block diagonal.
template <int dim>
ContactTangent BodyBySolutions<dim>::of_points(const std::vector<bool> &is_free,
                                               const std::vector<TangentMatrix> &hessian,
                                               const VectorXd &force) const {
  ContactTangent tangent;
  tangent.known = VectorXd::Zero(contact_.n_unknowns());
  for (std::size_t i = 0; i < contact_.points().size(); ++i) {
    const ContactPoint &p = contact_.points()[i];
    if (!is_free[i] || p.size == 0)
      continue;
    ContactTangent::Point &row = tangent.points.emplace_back();
    row.point = i;
    row.derivative = TangentMatrix::Zero(p.size, p.size);
    row.of_own = -hessian[i];
    row.right_side = -force.segment(p.offset, p.size);
  }
  return tangent;
}

template <int dim>
VectorXd BodyBySolutions<dim>::without_contact() {
  std::vector<TangentMatrix> none;
  for (const ContactPoint &p : contact_.points())
    none.push_back(TangentMatrix::Zero(p.size, p.size));
  const VectorXd rest = VectorXd::Zero(contact_.n_unknowns());
  const auto moved =
      solve(of_points(std::vector<bool>(contact_.points().size(), true), none, force(rest)));
  return moved ? moved->x : rest;
}

template <int dim>
VectorXd BodyBySolutions<dim>::direction(const std::vector<bool> &is_smooth,
                                         const std::vector<TangentMatrix> &hessian,
                                         const VectorXd &descent) {
  const auto moved = solve(of_points(is_smooth, hessian, descent));
  return moved ? moved->x : VectorXd();
}

template <int dim>
InterfaceSolution BodyBySolutions<dim>::minimise(const std::vector<ContactPoint> &points,
                                                 VectorXd start,
                                                 const InterfaceSettings &settings) {
  return solve::minimise(SlipProgramme{points, curvatures_}, *this, possible(std::move(start)),
                         settings);
}

template class BodyBySolutions<2>;
template class BodyBySolutions<3>;

}  // namespace tourmaline::solve
