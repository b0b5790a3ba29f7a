#include "solve/contact_by_solutions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

#include "larger.h"
#include "solve/contact_nodes.h"
#include "solve/coupled_programme.h"
#include "solve/first_places.h"
#include "solve/iterative_body.h"
#include "solve/leaning.h"
#include "solve/natural_map.h"
#include "solve/node_system.h"
#include "solve/slip_descent.h"
#include "tourmaline/error.h"

namespace tourmaline::solve {

namespace {

using contact::TangentMatrix;
using Eigen::Index;
using Eigen::VectorXd;

constexpr double slightly = 1e-8;  // of the stiffness of the contact's points

template <int dim>
class ContactBySolutions : public IterativeRoute<dim>, private ContactBody, private SlipResponse {
 public:
  explicit ContactBySolutions(const Model<dim> &model);

  VectorXd accumulated_slip() const override { return contact_.accumulated_slip(); }

 private:
  using IterativeRoute<dim>::model_;
  using IterativeRoute<dim>::body_;
  using IterativeRoute<dim>::time_;
  using IterativeRoute<dim>::state_;
  using IterativeRoute<dim>::iterations_;
  using IterativeRoute<dim>::so_far_;
  using IterativeRoute<dim>::left_to_contact_;
  using IterativeRoute<dim>::contact_tolerance;

  void begin_contact(std::span<const double> before) override;
  void settle() override;
  std::vector<double> freed(std::vector<double> residual) const override;
  void set_contact() override;
  StepOutcome outcome() override;
  std::string unheld() const override {
    return unheld_motions(model_, contact_, solution_.interface.status);
  }
  void save_contact(output::SavedNumbers &numbers) const override { contact_.save(numbers); }
  void restore_contact(const output::SavedNumbers &numbers) override { contact_.restore(numbers); }

  bool find_fast();
  CoupledSolution solve_from(const VectorXd &start);
  void find_safely(const VectorXd &start);
  [[noreturn]] void give_up_contact() const;

  VectorXd at_contact(std::span<const double> vector) const;
  VectorXd increments_of(std::span<const double> state) const;
  VectorXd possible(VectorXd d) const;
  void put(const VectorXd &d);
  void add_at_contact(const VectorXd &by_node, std::span<double> vector) const;
  double size_at_state() const;
  NaturalMap::Place place() const;
  CoupledContact coupled() { return {*this, contact_.points(), contact_.couplings()}; }
  std::vector<double> product(std::span<const double> x) const;
  bool correct(const NodeSystem<dim> &system, const VectorXd &known, const VectorXd &force,
               std::vector<double> residual, double reduction);
  ContactTangent with_springs(ContactTangent tangent) const;
  std::optional<Moved> response(const NodeSystem<dim> &system, const VectorXd &known,
                                const VectorXd &force, double reduction);
  bool add_shares(const NodeSystem<dim> &system, const ContactTangent &tangent, double reduction,
                  Moved &moved);
  std::vector<krylov::NodeTangent<dim>> held() const;
  ContactTangent of_points(const std::vector<bool> &is_free,
                           const std::vector<TangentMatrix> &hessian, const VectorXd &force) const;

  // ContactBody and SlipResponse
  VectorXd force(const VectorXd &d) override;
  double size_of_forces(const VectorXd &) const override { return size_; }
  bool is_within(const VectorXd &, double residual, double tolerance) const override {
    return relative_to(residual, size_) <= tolerance;
  }
  double largest_force() const override { return size_; }
  double curvature(std::size_t point) const override { return curvatures_[point]; }
  std::optional<Moved> solve(const ContactTangent &tangent) override;
  VectorXd without_contact() override;
  InterfaceSolution minimise(const std::vector<ContactPoint> &points, VectorXd start,
                             const InterfaceSettings &settings) override;
  VectorXd direction(const std::vector<bool> &is_smooth, const std::vector<TangentMatrix> &hessian,
                     const VectorXd &descent) override;
  double force_size() const override { return size_; }
  using IterativeRoute<dim>::accuracy;
  double force_accuracy() const override { return model_.asked.solver.linear_tolerance * size_; }

  ContactNodes<dim> contact_;
  std::vector<double> curvatures_;  // by point [N/m]
  VectorXd stiffness_;              // the same by unknown
  double springs_ = 0;  // to the foundation, over this stiffness: a means to find a start
  // Of the step at hand:
  VectorXd d_;      // unknowns of the contact nodes, as the state has them
  VectorXd force_;  // f - A d, where the body is solved with them
  bool is_solved_ = false;
  double size_ = 1;            // of the forces [N]
  std::vector<double> moved_;  // by the body in the last linear solve
  CoupledSolution solution_;
};

template <int dim>
ContactBySolutions<dim>::ContactBySolutions(const Model<dim> &model)
    : IterativeRoute<dim>(model),
      contact_(model, this->is_prescribed_),
      stiffness_(contact_.n_unknowns()) {
  const std::vector<double> diagonal = model.op.diagonal(model.step);
  for (std::size_t i = 0; i < contact_.points().size(); ++i) {
    const std::size_t first = body::unknown<dim>(model.interface[contact_.node_of(i)].node, 0);
    curvatures_.push_back(std::accumulate(&diagonal[first], &diagonal[first] + dim, 0.));
    stiffness_.segment(contact_.points()[i].offset, contact_.points()[i].size)
        .setConstant(curvatures_.back());
  }
}

template <int dim>
void ContactBySolutions<dim>::begin_contact(std::span<const double> before) {
  contact_.begin_step(time_, before, state_);
  moved_.assign(state_.size(), 0.);
  put(possible(increments_of(state_)));
}

template <int dim>
VectorXd ContactBySolutions<dim>::at_contact(std::span<const double> vector) const {
  VectorXd by_node(dim * static_cast<Index>(model_.interface.size()));
  for (std::size_t i = 0; i < model_.interface.size(); ++i)
    for (int c = 0; c < dim; ++c)
      by_node[dim * static_cast<Index>(i) + c] =
          vector[body::unknown<dim>(model_.interface[i].node, c)];
  return by_node;
}

template <int dim>
void ContactBySolutions<dim>::add_at_contact(const VectorXd &by_node,
                                             std::span<double> vector) const {
  for (std::size_t i = 0; i < model_.interface.size(); ++i)
    for (int c = 0; c < dim; ++c)
      vector[body::unknown<dim>(model_.interface[i].node, c)] +=
          by_node[dim * static_cast<Index>(i) + c];
}

template <int dim>
VectorXd ContactBySolutions<dim>::increments_of(std::span<const double> state) const {
  const VectorXd start = contact_.displacements(VectorXd::Zero(contact_.n_unknowns()));
  return contact_.directions().transpose() * (at_contact(state) - start);
}

// Nearby penetrations that the laws allow.
template <int dim>
VectorXd ContactBySolutions<dim>::possible(VectorXd d) const {
  for (const ContactPoint &p : contact_.points())
    if (!std::isfinite(p.law.potential(d.segment(p.offset, p.size))))
      d.segment(p.offset, p.size).setZero();
  return d;
}

template <int dim>
void ContactBySolutions<dim>::put(const VectorXd &d) {
  d_ = d;
  is_solved_ = false;
  const VectorXd c = contact_.displacements(d);
  for (std::size_t i = 0; i < model_.interface.size(); ++i)
    for (int k = 0; k < dim; ++k)
      if (const std::size_t u = body::unknown<dim>(model_.interface[i].node, k);
          !this->is_prescribed_[u])
        state_[u] = c[dim * static_cast<Index>(i) + k];
}

// Where there are no forces, as the body has left the foundation, round-off is what counts.
template <int dim>
double ContactBySolutions<dim>::size_at_state() const {
  const auto [largest, round_off] = body_.nodal_forces();
  const double size = larger(
      largest, larger(round_off, body_.first_nodal_forces().round_off) / contact_tolerance());
  return size == 0 ? 1 : size;
}

// What contact and prescribed unknowns leave free of a residual.
template <int dim>
std::vector<double> ContactBySolutions<dim>::freed(std::vector<double> residual) const {
  for (std::size_t i = 0; i < residual.size(); ++i)
    if (this->is_prescribed_[i])
      residual[i] = 0;
  for (const contact::InterfaceNode<dim> &at : model_.interface)
    std::fill_n(&residual[body::unknown<dim>(at.node, 0)], dim, 0.);
  return residual;
}

template <int dim>
std::vector<krylov::NodeTangent<dim>> ContactBySolutions<dim>::held() const {
  ContactTangent nothing;
  nothing.known = VectorXd::Zero(contact_.n_unknowns());
  return NodeSystem<dim>(contact_, model_, nothing).tangents;
}

template <int dim>
void ContactBySolutions<dim>::set_contact() {
  body_.system().set_contact(held());
}

template <int dim>
NaturalMap::Place ContactBySolutions<dim>::place() const {
  return {d_, contact_.directions().transpose() * at_contact(body_.residual()), {}};
}

template <int dim>
std::vector<double> ContactBySolutions<dim>::product(std::span<const double> x) const {
  std::vector<double> product(x.size());
  if (body_.is_refined())
    model_.cells.multiply(model_.step, x, product);
  else
    model_.op.multiply(model_.step, x, product);
  return product;
}

// Adds to the state the `known` increments of the contact and what follows from them, from nodal
// `force` [N] in its free directions, and from what the free unknowns beside it leave of their
// equations, `residual`.
template <int dim>
bool ContactBySolutions<dim>::correct(const NodeSystem<dim> &system, const VectorXd &known,
                                      const VectorXd &force, std::vector<double> residual,
                                      double reduction) {
  std::vector<double> moved(state_.size(), 0.);
  add_at_contact(contact_.directions() * known, moved);
  const std::vector<double> resisted = product(moved);
  for (std::size_t i = 0; i < residual.size(); ++i)
    residual[i] -= resisted[i];
  const VectorXd resisting = at_contact(resisted), x = at_contact(moved);
  VectorXd coupled = contact_.directions() * force;
  for (std::size_t i = 0; i < system.couplings.size(); ++i) {
    const auto at = Eigen::seqN(dim * static_cast<Index>(i), dim);
    coupled(at) -= system.couplings[i].of_force * resisting(at) +
                   (system.couplings[i].of_displacement + system.tangents[i].stiffness) * x(at);
  }
  add_at_contact(coupled, residual);
  body_.system().set_contact(system.tangents);
  if (system.is_coupled())
    body_.system().set_coupling(system.couplings);
  body_.system().project(residual);
  const bool solved = body_.correct(residual, reduction);
  body_.system().set_coupling({});
  for (std::size_t i = 0; i < state_.size(); ++i)
    state_[i] += moved[i];
  return solved;
}

// The same without changing the state.
template <int dim>
std::optional<ContactBody::Moved> ContactBySolutions<dim>::response(const NodeSystem<dim> &system,
                                                                    const VectorXd &known,
                                                                    const VectorXd &force,
                                                                    double reduction) {
  const std::vector<double> state(state_.begin(), state_.end());
  const bool solved =
      correct(system, known, force, std::vector<double>(state.size(), 0.), reduction);
  for (std::size_t i = 0; i < state.size(); ++i)
    moved_[i] = state_[i] - state[i];
  std::copy(state.begin(), state.end(), state_.begin());
  if (!solved)
    return std::nullopt;
  const auto transposed = contact_.directions().transpose();
  return Moved{transposed * at_contact(moved_), transposed * at_contact(product(moved_)), {}};
}

template <int dim>
std::optional<ContactBody::Moved> ContactBySolutions<dim>::solve(const ContactTangent &tangent) {
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
ContactTangent ContactBySolutions<dim>::with_springs(ContactTangent tangent) const {
  const double springs = springs_ + (left_to_contact_.empty() ? 0 : slightly);
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
bool ContactBySolutions<dim>::add_shares(const NodeSystem<dim> &system,
                                         const ContactTangent &tangent, double reduction,
                                         Moved &moved) {
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
  const VectorXd found = matrix.partialPivLu().solve(right_side);
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
VectorXd ContactBySolutions<dim>::force(const VectorXd &d) {
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
ContactTangent ContactBySolutions<dim>::of_points(const std::vector<bool> &is_free,
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
VectorXd ContactBySolutions<dim>::without_contact() {
  std::vector<TangentMatrix> none;
  for (const ContactPoint &p : contact_.points())
    none.push_back(TangentMatrix::Zero(p.size, p.size));
  const VectorXd rest = VectorXd::Zero(contact_.n_unknowns());
  const auto moved =
      solve(of_points(std::vector<bool>(contact_.points().size(), true), none, force(rest)));
  return moved ? moved->x : rest;
}

template <int dim>
VectorXd ContactBySolutions<dim>::direction(const std::vector<bool> &is_smooth,
                                            const std::vector<TangentMatrix> &hessian,
                                            const VectorXd &descent) {
  const auto moved = solve(of_points(is_smooth, hessian, descent));
  return moved ? moved->x : VectorXd();
}

template <int dim>
InterfaceSolution ContactBySolutions<dim>::minimise(const std::vector<ContactPoint> &points,
                                                    VectorXd start,
                                                    const InterfaceSettings &settings) {
  return solve::minimise(SlipProgramme{points, curvatures_}, *this, possible(std::move(start)),
                         settings);
}

// Newton's method on all unknowns at once, in which body and contact settle together. It may cycle;
// false when it has gained nothing in a while.
template <int dim>
bool ContactBySolutions<dim>::find_fast() {
  constexpr int patience = 10, most = 30;
  constexpr double reduction = 1e-2;     // what is left, the next iteration takes
  constexpr std::size_t tiresome = 100;  // linear iterations: friction is stiffer than the body
  const NaturalMap map(coupled(), 1);
  double least = std::numeric_limits<double>::infinity(), least_of_body = least;
  for (int k = 0, last_gain = 0; k <= most && k - last_gain < patience; ++k) {
    body_.update_residual();
    size_ = size_at_state();
    const NaturalMap::Place x = place();
    const ContactTangent tangent = map.tangent(x);
    const NodeSystem<dim> system(contact_, model_, with_springs(tangent));
    const std::vector<double> residual = freed(body_.residual());
    const double worst = map.residual(x);
    const bool contact_is_solved = worst <= contact_tolerance();
    if (k > 0 && contact_is_solved && body_.is_solved(residual)) {
      if (tangent.known.isZero(0)) {
        solution_ = map.solution(x);
        return true;
      }
      put(d_ + tangent.known);  // held points exactly where they are held
      continue;
    }
    if (worst < least || (contact_is_solved && body_.lack() < least_of_body))
      last_gain = k;
    least = std::min(least, worst);
    if (contact_is_solved)
      least_of_body = std::min(least_of_body, body_.lack());
    const std::size_t before = so_far_.krylov_iterations;
    ++iterations_;
    if (!correct(system, system.known, system.force, residual, reduction) ||
        so_far_.krylov_iterations - before > tiresome)
      return false;
    const VectorXd moved = contact_.directions().transpose() * at_contact(body_.increment());
    VectorXd next = d_ + system.known;
    for (const ContactTangent::Point &at : tangent.points) {
      const ContactPoint &p = contact_.points()[at.point];
      next.segment(p.offset, p.size) += moved.segment(p.offset, p.size);
      // a slip that turns is caught
      if (p.law.normal() == nullptr && p.law.held().isZero(0) &&
          next.segment(p.offset, p.size).dot(d_.segment(p.offset, p.size)) < 0)
        next.segment(p.offset, p.size).setZero();
    }
    put(next);
  }
  return false;
}

template <int dim>
CoupledSolution ContactBySolutions<dim>::solve_from(const VectorXd &start) {
  moved_.assign(state_.size(), 0.);
  is_solved_ = false;
  const InterfaceSettings settings{contact_tolerance(), model_.asked.solver.max_iterations,
                                   left_to_contact_.empty()};
  return solve_coupled(coupled(), start, settings);
}

// Where only the contact holds the body, a linear system on the way may have no solution. Weak
// springs between contact and foundation lead to where the contact holds.
template <int dim>
void ContactBySolutions<dim>::find_safely(const VectorXd &start) {
  ++so_far_.safe_steps;
  solution_ = solve_from(start);
  VectorXd sprung = start;
  for (const double weak : {1e-2, 1e-4, 1e-6}) {
    if (solution_.interface.converged || left_to_contact_.empty())
      break;
    springs_ = weak;
    sprung = solve_from(sprung).interface.increment;
    springs_ = 0;
    solution_ = solve_from(sprung);
  }
  if (!solution_.interface.converged)
    give_up_contact();
}

// Both stages begin with the state that is predicted.
template <int dim>
void ContactBySolutions<dim>::settle() {
  const VectorXd start = d_;
  const std::vector<double> state(state_.begin(), state_.end());
  if (!find_fast()) {
    std::copy(state.begin(), state.end(), state_.begin());
    find_safely(start);
  }
  if (!contact_.is_coupled())
    solution_.stage = ContactStage::convex;
}

template <int dim>
StepOutcome ContactBySolutions<dim>::outcome() {
  const auto n = static_cast<Index>(model_.interface.size());
  StepOutcome outcome;
  outcome.contact_forces = -at_contact(body_.residual());
  outcome.friction_forces = VectorXd::Zero(dim * n);
  outcome.status.resize(model_.interface.size());
  if (contact_.is_coupled())
    outcome.friction_bound = VectorXd::Zero(n);
  if (model_.laws.remembers_slip())
    outcome.accumulated_slip = VectorXd::Zero(n);
  solution_.interface.iterations = iterations_;
  contact_.end_step(solution_, outcome);
  return outcome;
}

template <int dim>
void ContactBySolutions<dim>::give_up_contact() const {
  if (const std::string motions = left_to_contact_.empty() ? "" : unheld(); !motions.empty())
    let_go(time_, motions);
  if (!left_to_contact_.empty())
    give_up_leaning(time_, solution_.interface, left_to_contact_);
  const std::vector<std::size_t> &unsettled = solution_.interface.unsettled;
  throw SolveError(fmt::format(
      "the contact iteration did not converge at t = {:g} s: residual {:.3g} of the largest force "
      "after {} Newton iterations, wanted {:.3g}; {} points are unsettled, among them{}; raise "
      "solver.max_iterations or solver.linear_tolerance, take smaller time steps, or take "
      "solver.body = \"direct\"",
      time_, solution_.interface.residual, iterations_, contact_tolerance(), unsettled.size(),
      first_places(unsettled.size(), [&](std::size_t i) {
        return model_.interface[contact_.node_of(unsettled[i])].point;
      })));
}

}  // namespace

template <int dim>
std::unique_ptr<Route> contact_by_solutions(const Model<dim> &model) {
  return std::make_unique<ContactBySolutions<dim>>(model);
}

template std::unique_ptr<Route> contact_by_solutions<2>(const Model<2> &);
template std::unique_ptr<Route> contact_by_solutions<3>(const Model<3> &);

}  // namespace tourmaline::solve
