#include "tourmaline/solve/iterative_route.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "tourmaline/contact/bilateral.h"
#include "tourmaline/contact/friction.h"
#include "tourmaline/error.h"
#include "tourmaline/krylov/body_system.h"
#include "tourmaline/larger.h"
#include "tourmaline/stopwatch.h"

namespace tourmaline::solve {

namespace {

using body::Fields;
using body::unknown;
using contact::Tangent;
using contact::TangentMatrix;
using output::ContactStatus;

// The contact at one node in the step at hand.
template <int dim>
struct Point {
  contact::Admissible<dim> admissible;
  contact::Friction friction;
  Tangent slip_before;  // of the last step, D^T u [m]
  Tangent slip;         // increment d over this step [m]
  bool slips = false;   // in the active set

  bool is_held() const { return admissible.directions.cols() == 0; }
};

template <class Function>
auto with_law(const contact::Friction &friction, Function &&f) {
  return std::visit(std::forward<Function>(f), friction);
}

template <int dim>
class IterativeRoute : public Route {
 public:
  explicit IterativeRoute(const Model<dim> &model);

  StepOutcome advance(double time, std::span<const double> right_side,
                      std::span<const double> before, std::span<double> state) override;
  Accuracy accuracy(std::span<const double>, std::span<const double>,
                    const StepOutcome &) override {
    return {.backward_error = backward_error_};
  }
  Accuracy accuracy_so_far() const override { return {.backward_error = backward_error_}; }
  RouteReport report() const override;
  void save(output::SavedNumbers &numbers) const override;
  void restore(const output::SavedNumbers &numbers) override;

 private:
  using Vector = Eigen::Matrix<double, dim, 1>;

  void begin_step(double time, std::span<const double> before, std::span<double> state);
  contact::Admissible<dim> admissible(std::size_t node, std::span<const double> state) const;
  Vector displacement(std::span<const double> state, std::size_t node) const;
  void impose(std::span<double> state) const;
  void read_slips(std::span<const double> state);
  bool change_active_set();
  void update_residual(std::span<const double> right_side, std::span<const double> state);
  Vector force(std::size_t node) const;
  Tangent slip_force(std::size_t node) const;
  double curvature(std::size_t node) const;
  double contact_residual(std::size_t node) const;
  double largest_force() const;
  std::array<double, 3> field_sizes(std::span<const double> state) const;
  bool body_is_solved(std::span<const double> state) const;
  void newton_step(std::span<double> state);
  std::vector<double> newton_residual() const;
  std::vector<krylov::NodeTangent<dim>> tangents() const;
  StepOutcome outcome() const;
  [[noreturn]] void give_up(double time) const;

  const Model<dim> &model_;
  krylov::BodySystem<dim> system_;
  std::vector<double> diagonal_;
  std::vector<bool> is_prescribed_;
  std::vector<Point<dim>> points_;
  std::vector<double> residual_;  // b - K x, at contact nodes the force that the contact bears
  std::vector<double> two_before_;
  std::vector<double> increment_;
  int iterations_ = 0;  // Newton iterations of this step
  std::size_t krylov_iterations_ = 0;
  int krylov_largest_ = 0;
  double linear_seconds_ = 0, backward_error_ = 0;
};

template <int dim>
IterativeRoute<dim>::IterativeRoute(const Model<dim> &model)
    : model_(model),
      system_(model.op, model.step, model.body.points(), model.prescribed),
      diagonal_(model.op.diagonal(model.step)),
      is_prescribed_(model.n_unknowns(), false),
      points_(model.interface.size()),
      residual_(model.n_unknowns()),
      increment_(model.n_unknowns()) {
  for (const body::Prescribed &p : model.prescribed)
    is_prescribed_[p.unknown] = true;
}

template <int dim>
contact::Admissible<dim> IterativeRoute<dim>::admissible(std::size_t node,
                                                         std::span<const double> state) const {
  std::array<std::optional<double>, dim> prescribed;
  for (int c = 0; c < dim; ++c)
    if (const std::size_t i = unknown<dim>(model_.interface[node].node, c); is_prescribed_[i])
      prescribed[c] = state[i];
  return contact::bilateral<dim>(model_.interface[node].normal, prescribed);
}

template <int dim>
typename IterativeRoute<dim>::Vector IterativeRoute<dim>::displacement(
    std::span<const double> state, std::size_t node) const {
  return Vector::Map(&state[unknown<dim>(model_.interface[node].node, 0)]);
}

// The prediction: the change of the last step once more; a point goes on as it did, unless that
// would turn its slip.
template <int dim>
void IterativeRoute<dim>::begin_step(double time, std::span<const double> before,
                                     std::span<double> state) {
  if (!two_before_.empty())
    for (std::size_t i = 0; i < state.size(); ++i)
      if (!is_prescribed_[i])
        state[i] += before[i] - two_before_[i];
  for (std::size_t i = 0; i < points_.size(); ++i) {
    Point<dim> &p = points_[i];
    p.admissible = admissible(i, state);
    p.friction = model_.friction(
        contact::contact_place(model_.interface[i].point, time, p.admissible.directions));
    p.slip_before = p.admissible.directions.transpose() * displacement(before, i);
    p.slip =
        p.admissible.directions.transpose() * (displacement(state, i) - displacement(before, i));
    p.slips = p.slips && p.slip.norm() > 0;
  }
  two_before_.assign(before.begin(), before.end());
  iterations_ = 0;
  impose(state);
}

// Contact displacements from the slips: a sticking point has none.
template <int dim>
void IterativeRoute<dim>::impose(std::span<double> state) const {
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const Point<dim> &p = points_[i];
    const Tangent slip = p.slips ? Tangent(p.slip_before + p.slip) : p.slip_before;
    const Vector u = p.admissible.base + p.admissible.directions * slip;
    std::copy(u.begin(), u.end(), &state[unknown<dim>(model_.interface[i].node, 0)]);
  }
}

template <int dim>
void IterativeRoute<dim>::update_residual(std::span<const double> right_side,
                                          std::span<const double> state) {
  model_.op.multiply(model_.step, state, residual_);
  for (std::size_t i = 0; i < residual_.size(); ++i)
    residual_[i] = right_side[i] - residual_[i];
}

// Nodal force with which the point pushes on the foundation [N].
template <int dim>
typename IterativeRoute<dim>::Vector IterativeRoute<dim>::force(std::size_t node) const {
  return displacement(residual_, node);
}

template <int dim>
Tangent IterativeRoute<dim>::slip_force(std::size_t node) const {
  return points_[node].admissible.directions.transpose() * force(node);
}

// Largest stiffness of the point's own block, by its trace [N/m].
template <int dim>
double IterativeRoute<dim>::curvature(std::size_t node) const {
  double sum = 0;
  for (int c = 0; c < dim; ++c)
    sum += diagonal_[unknown<dim>(model_.interface[node].node, c)];
  return sum;
}

// lambda - P(lambda + r d) as a nodal force [N].
template <int dim>
double IterativeRoute<dim>::contact_residual(std::size_t node) const {
  const Point<dim> &p = points_[node];
  if (p.is_held())
    return 0;
  const double weight = model_.interface[node].weight;
  const Tangent lambda = slip_force(node) / weight;
  const Tangent slip = p.slips ? p.slip : Tangent(Tangent::Zero(p.slip.size()));
  const Tangent trial = lambda + curvature(node) / weight * slip;
  return weight * (lambda - with_law(p.friction, [&](const auto &law) {
                     return law.traction(trial);
                   })).norm();
}

template <int dim>
double IterativeRoute<dim>::largest_force() const {
  double largest = 1e-300;
  for (std::size_t i = 0; i < points_.size(); ++i)
    largest = larger(largest, force(i).norm());
  return largest;
}

// Lets points go and catches them; true when the set changed.
template <int dim>
bool IterativeRoute<dim>::change_active_set() {
  bool changed = false;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    Point<dim> &p = points_[i];
    if (p.is_held() || p.slips)
      continue;
    const double weight = model_.interface[i].weight;
    const Tangent lambda = slip_force(i) / weight;
    const Tangent beyond =
        lambda - with_law(p.friction, [&](const auto &law) { return law.traction(lambda); });
    if (beyond.norm() <= 1e-12 * lambda.norm())
      continue;
    p.slips = changed = true;
    p.slip = beyond * (weight / curvature(i));
  }
  return changed;
}

// Sizes of the forces, charges and heats that balance in each field's rows: each the norm of what
// one field contributes.
template <int dim>
std::array<double, 3> IterativeRoute<dim>::field_sizes(std::span<const double> state) const {
  body::FieldProducts products;
  model_.op.multiply_by_field(state, products);
  std::array<double, 3> sizes{};
  for (const std::vector<double> &product : products.of) {
    std::array<double, 3> squares{};
    for (std::size_t i = 0; i < product.size(); ++i)
      squares[std::max(0, static_cast<int>(i % Fields<dim>::count) - dim + 1)] +=
          product[i] * product[i];
    for (int f = 0; f < 3; ++f)
      sizes[f] = larger(sizes[f], std::sqrt(squares[f]));
  }
  return sizes;
}

template <int dim>
std::vector<double> IterativeRoute<dim>::newton_residual() const {
  std::vector<double> r = residual_;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const Point<dim> &p = points_[i];
    if (!p.slips)
      continue;
    const Vector friction =
        model_.interface[i].weight * p.admissible.directions *
        with_law(p.friction, [&](const auto &law) { return law.gradient(p.slip); });
    for (int c = 0; c < dim; ++c)
      r[unknown<dim>(model_.interface[i].node, c)] -= friction[c];
  }
  system_.project(r);
  return r;
}

template <int dim>
bool IterativeRoute<dim>::body_is_solved(std::span<const double> state) const {
  const std::vector<double> r = newton_residual();
  const std::array<double, 3> sizes = field_sizes(state);
  std::array<double, 3> squares{};
  for (std::size_t i = 0; i < r.size(); ++i)
    squares[std::max(0, static_cast<int>(i % Fields<dim>::count) - dim + 1)] += r[i] * r[i];
  for (int f = 0; f < 3; ++f)
    if (!(relative_to(std::sqrt(squares[f]), sizes[f]) <= model_.asked.solver.linear_tolerance))
      return false;
  return true;
}

template <int dim>
std::vector<krylov::NodeTangent<dim>> IterativeRoute<dim>::tangents() const {
  std::vector<krylov::NodeTangent<dim>> tangents;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const Point<dim> &p = points_[i];
    krylov::NodeTangent<dim> t{model_.interface[i].node, {}, {}};
    t.projector.setZero();
    t.stiffness.setZero();
    if (p.slips) {
      const auto &d = p.admissible.directions;
      t.projector = d * d.transpose();
      t.stiffness = model_.interface[i].weight * d *
                    with_law(p.friction, [&](const auto &law) { return law.hessian(p.slip); }) *
                    d.transpose();
    }
    tangents.push_back(t);
  }
  return tangents;
}

template <int dim>
void IterativeRoute<dim>::newton_step(std::span<double> state) {
  constexpr double reduction = 1e-2;  // what is left, the next iteration takes
  Stopwatch watch;
  system_.set_contact(tangents());
  const int iterations = system_.solve(newton_residual(), reduction, increment_);
  krylov_iterations_ += iterations;
  krylov_largest_ = std::max(krylov_largest_, iterations);
  linear_seconds_ += watch.lap();
  for (std::size_t i = 0; i < state.size(); ++i)
    state[i] += increment_[i];
  ++iterations_;
}

// Slips as the state has them now; a point whose slip has turned is caught.
template <int dim>
void IterativeRoute<dim>::read_slips(std::span<const double> state) {
  for (std::size_t i = 0; i < points_.size(); ++i) {
    Point<dim> &p = points_[i];
    if (!p.slips)
      continue;
    const Tangent slip =
        p.admissible.directions.transpose() * displacement(state, i) - p.slip_before;
    const bool bounded = with_law(
        p.friction, [&](const auto &law) { return !law.is_smooth_at(Tangent::Zero(slip.size())); });
    if (bounded && slip.dot(p.slip) <= 0)
      p.slips = false;
    p.slip = slip;
  }
}

template <int dim>
StepOutcome IterativeRoute<dim>::advance(double time, std::span<const double> right_side,
                                         std::span<const double> before, std::span<double> state) {
  begin_step(time, before, state);
  system_.set_contact(tangents());
  system_.refresh();
  const double tolerance =
      std::max(model_.asked.solver.tolerance, model_.asked.solver.linear_tolerance);
  while (true) {
    update_residual(right_side, state);
    if (iterations_ > 0) {
      double worst = 0;
      for (std::size_t i = 0; i < points_.size(); ++i)
        worst = larger(worst, contact_residual(i));
      if (relative_to(worst, largest_force()) <= 10 * tolerance && body_is_solved(state))
        break;
      if (iterations_ >= model_.asked.solver.max_iterations)
        give_up(time);
      if (change_active_set()) {
        impose(state);
        update_residual(right_side, state);
      }
    }
    newton_step(state);
    read_slips(state);
    impose(state);
  }
  backward_error_ =
      larger(backward_error_, system_.backward_error(newton_residual(), right_side, state));
  return outcome();
}

template <int dim>
StepOutcome IterativeRoute<dim>::outcome() const {
  StepOutcome outcome;
  outcome.newton_iterations = iterations_;
  outcome.contact_forces = Eigen::VectorXd::Zero(dim * static_cast<Eigen::Index>(points_.size()));
  double worst = 0;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const Point<dim> &p = points_[i];
    Vector q = -force(i);
    if (p.slips && !p.is_held()) {  // the friction is the law's
      const auto &d = p.admissible.directions;
      const Tangent lambda =
          with_law(p.friction, [&](const auto &law) { return law.gradient(p.slip); });
      q -= d * (d.transpose() * q + model_.interface[i].weight * lambda);
    }
    outcome.contact_forces.segment<dim>(dim * static_cast<Eigen::Index>(i)) = q;
    outcome.status.push_back(p.slips ? ContactStatus::slip : ContactStatus::stick);
    worst = larger(worst, contact_residual(i));
  }
  outcome.residual = worst / largest_force();
  return outcome;
}

template <int dim>
void IterativeRoute<dim>::give_up(double time) const {
  double worst = 0;
  for (std::size_t i = 0; i < points_.size(); ++i)
    worst = larger(worst, contact_residual(i));
  throw SolveError(fmt::format(
      "the iteration did not converge at t = {:g} s: after {} Newton iterations the contact's "
      "residual is {:.3g} of the largest force; take smaller time steps, raise "
      "solver.max_iterations or solver.linear_tolerance, or take solver.body = \"direct\"",
      time, iterations_, worst / largest_force()));
}

template <int dim>
RouteReport IterativeRoute<dim>::report() const {
  RouteReport report;
  report.condense_seconds = system_.set_up_seconds();
  report.substitution_seconds = linear_seconds_;
  report.unknowns = std::count(is_prescribed_.begin(), is_prescribed_.end(), false);
  report.krylov_iterations = krylov_iterations_;
  report.krylov_largest = krylov_largest_;
  report.preconditioners = system_.set_ups();
  report.backward_error = backward_error_;
  return report;
}

template <int dim>
void IterativeRoute<dim>::save(output::SavedNumbers &numbers) const {
  std::vector<double> slips;
  for (const Point<dim> &p : points_)
    slips.push_back(p.slips);
  system_.save(numbers);
  numbers.put("active set", slips);
  numbers.put("state before", two_before_);
  numbers.put("route", {double(krylov_iterations_), double(krylov_largest_), backward_error_,
                        linear_seconds_});
}

template <int dim>
void IterativeRoute<dim>::restore(const output::SavedNumbers &numbers) {
  system_.restore(numbers, points_.size());
  const auto slips = numbers.get("active set", points_.size());
  for (std::size_t i = 0; i < points_.size(); ++i)
    points_[i].slips = slips[i] != 0;
  two_before_.resize(model_.n_unknowns());
  numbers.fill("state before", two_before_);
  const auto route = numbers.get("route", 4);
  krylov_iterations_ = static_cast<std::size_t>(route[0]);
  krylov_largest_ = static_cast<int>(route[1]);
  backward_error_ = route[2];
  linear_seconds_ = route[3];
}

}  // namespace

template <int dim>
std::unique_ptr<Route> iterative_route(const Model<dim> &model) {
  return std::make_unique<IterativeRoute<dim>>(model);
}

template std::unique_ptr<Route> iterative_route<2>(const Model<2> &);
template std::unique_ptr<Route> iterative_route<3>(const Model<3> &);

}  // namespace tourmaline::solve
