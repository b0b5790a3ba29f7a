#include "solve/iterative_route.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>

#include "contact/bilateral.h"
#include "contact/point_law.h"
#include "krylov/body_system.h"
#include "larger.h"
#include "solve/slip_descent.h"
#include "stopwatch.h"
#include "tourmaline/error.h"

namespace tourmaline::solve {

namespace {

using body::Fields;
using body::unknown;
using contact::Tangent;
using contact::TangentMatrix;

// Forward errors above it are worth refinement.
constexpr double worth_refining = 1e-7;
constexpr double of_a_correction = 1e-12;  // reduction of the residual that it is asked for
constexpr double enough = 1e-15;           // a correction that changes no digit

// The contact at one node in the step at hand.
template <int dim>
struct Point {
  contact::Admissible<dim> admissible;
  contact::PointLaw friction;
  Tangent slip_before;  // of the last step, D^T u [m]
  Tangent slip;         // increment d over this step [m]
  bool slips = false;   // in the active set

  bool is_held() const { return admissible.directions.cols() == 0; }
};

template <int dim>
class IterativeRoute : public Route, private SlipResponse {
 public:
  explicit IterativeRoute(const Model<dim> &model);

  StepOutcome advance(double time, std::span<const double> right_side,
                      std::span<const double> before, std::span<double> state) override;
  Accuracy accuracy(std::span<const double>, std::span<const double>,
                    const StepOutcome &) override {
    return accuracy_;
  }
  Accuracy accuracy_so_far() const override { return accuracy_; }
  bool is_refined() const override { return system_.is_refined(); }
  RouteReport report() const override;
  void save(output::SavedNumbers &numbers) const override;
  void restore(const output::SavedNumbers &numbers) override;

 private:
  using Vector = Eigen::Matrix<double, dim, 1>;

  void begin_step(double time, std::span<const double> right_side, std::span<const double> before,
                  std::span<double> state);
  contact::Admissible<dim> admissible(std::size_t node, std::span<const double> state) const;
  Vector displacement(std::span<const double> state, std::size_t node) const;
  void impose();
  void read_slips();
  bool change_active_set();
  void update_residual();
  Vector nodal_force(std::size_t node) const;
  Tangent slip_force(std::size_t node) const;
  double curvature(std::size_t node) const;
  Tangent slip(std::size_t node) const;
  Tangent trial(std::size_t node) const;
  double contact_residual(std::size_t node) const;
  double largest_residual() const;
  double terms_at_contact() const;
  double contact_tolerance() const;
  std::array<double, 3> norms(std::span<const double> rows) const;
  std::array<double, 3> field_sizes() const;
  std::array<double, 3> round_off() const;
  bool body_is_solved();
  std::vector<double> newton_residual() const;
  std::vector<krylov::NodeTangent<dim>> tangents() const;
  std::vector<krylov::NodeTangent<dim>> held() const;
  bool add_solution(std::span<const double> residual, double reduction);
  bool newton_step();

  bool find_fast();
  void find_safely();
  void solve_body();
  std::vector<ContactPoint> slip_points() const;
  Eigen::VectorXd slips_of(std::span<const double> vector) const;
  Eigen::VectorXd force(const Eigen::VectorXd &d) override;
  Eigen::VectorXd direction(const std::vector<bool> &is_smooth,
                            const std::vector<TangentMatrix> &hessian,
                            const Eigen::VectorXd &descent) override;
  double force_size() const override;
  double accuracy() const override;

  void settle();
  double forward_error();
  void measure();
  void share_forces(std::size_t node, StepOutcome &outcome) const;
  StepOutcome outcome() const;
  [[noreturn]] void give_up_contact(const InterfaceSolution &solution) const;
  [[noreturn]] void give_up_body() const;

  const Model<dim> &model_;
  krylov::BodySystem<dim> system_;
  std::vector<double> diagonal_;
  std::vector<bool> is_prescribed_;
  std::vector<Point<dim>> points_;
  std::vector<double> residual_;  // b - K x, at contact nodes the force that the contact bears
  std::vector<double> two_before_;
  std::vector<double> increment_;  // of the last linear solve
  // Of the step at hand:
  double time_ = 0;
  std::span<const double> right_side_;
  std::span<double> state_;
  int iterations_ = 0;    // Newton iterations
  double body_lack_ = 0;  // residual of the body's rows over what is allowed
  double terms_at_contact_ = 0;
  int safe_steps_ = 0;  // which needed the descent
  std::size_t krylov_iterations_ = 0;
  int krylov_largest_ = 0;
  double linear_seconds_ = 0;
  double correction_ = 0;  // size of the last, once refined
  bool corrections_fell_ = true;
  Accuracy accuracy_{.backward_error = 0};  // largest of the steps in which it was measured
  bool measured_ = false;
};

template <int dim>
IterativeRoute<dim>::IterativeRoute(const Model<dim> &model)
    : model_(model),
      system_(model.op, model.step, model.body.points(), model.prescribed),
      diagonal_(model.op.diagonal(model.step)),
      is_prescribed_(body::mask_of(model.prescribed, model.n_unknowns())),
      points_(model.interface.size()),
      residual_(model.n_unknowns()),
      increment_(model.n_unknowns()) {}

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
void IterativeRoute<dim>::begin_step(double time, std::span<const double> right_side,
                                     std::span<const double> before, std::span<double> state) {
  time_ = time;
  right_side_ = right_side;
  state_ = state;
  if (!two_before_.empty())
    for (std::size_t i = 0; i < state.size(); ++i)
      if (!is_prescribed_[i])
        state[i] += before[i] - two_before_[i];
  for (std::size_t i = 0; i < points_.size(); ++i) {
    Point<dim> &p = points_[i];
    p.admissible = admissible(i, state);
    p.friction = {model_.friction(contact::contact_place(model_.interface[i].point, time,
                                                         p.admissible.tangent())),
                  p.admissible.held_slip(displacement(before, i))};
    p.slip_before = p.admissible.directions.transpose() * displacement(before, i);
    p.slip =
        p.admissible.directions.transpose() * (displacement(state, i) - displacement(before, i));
    p.slips =
        !p.is_held() && (!p.friction.has_kink(p.slip.size()) || (p.slips && p.slip.norm() > 0));
  }
  two_before_.assign(before.begin(), before.end());
  iterations_ = 0;
  correction_ = std::numeric_limits<double>::infinity();
  corrections_fell_ = true;
  body_lack_ = std::numeric_limits<double>::infinity();
  std::fill(increment_.begin(), increment_.end(), 0.);
  impose();
  update_residual();
  terms_at_contact_ = terms_at_contact();
}

// Contact displacements from the slips: a sticking point has none.
template <int dim>
void IterativeRoute<dim>::impose() {
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const Point<dim> &p = points_[i];
    const Tangent slip = p.slips ? Tangent(p.slip_before + p.slip) : p.slip_before;
    const Vector u = p.admissible.base + p.admissible.directions * slip;
    std::copy(u.begin(), u.end(), &state_[unknown<dim>(model_.interface[i].node, 0)]);
  }
}

template <int dim>
void IterativeRoute<dim>::update_residual() {
  if (is_refined())
    model_.cells.multiply(model_.step, state_, residual_);
  else
    model_.op.multiply(model_.step, state_, residual_);
  for (std::size_t i = 0; i < residual_.size(); ++i)
    residual_[i] = right_side_[i] - residual_[i];
}

// With which the point pushes on the foundation [N].
template <int dim>
typename IterativeRoute<dim>::Vector IterativeRoute<dim>::nodal_force(std::size_t node) const {
  return displacement(residual_, node);
}

template <int dim>
Tangent IterativeRoute<dim>::slip_force(std::size_t node) const {
  return points_[node].admissible.directions.transpose() * nodal_force(node);
}

// Largest stiffness of the point's own block, by its trace [N/m].
template <int dim>
double IterativeRoute<dim>::curvature(std::size_t node) const {
  double sum = 0;
  for (int c = 0; c < dim; ++c)
    sum += diagonal_[unknown<dim>(model_.interface[node].node, c)];
  return sum;
}

template <int dim>
Tangent IterativeRoute<dim>::slip(std::size_t node) const {
  const Point<dim> &p = points_[node];
  return p.slips ? p.slip : Tangent(Tangent::Zero(p.slip.size()));
}

// lambda + r d [N/m^2] with r = curvature / weight.
template <int dim>
Tangent IterativeRoute<dim>::trial(std::size_t node) const {
  return (slip_force(node) + curvature(node) * slip(node)) / model_.interface[node].weight;
}

// lambda - P(lambda + r d) as a nodal force [N].
template <int dim>
double IterativeRoute<dim>::contact_residual(std::size_t node) const {
  const double weight = model_.interface[node].weight;
  return (slip_force(node) -
          weight * points_[node].friction.traction(trial(node), curvature(node) / weight))
      .norm();
}

template <int dim>
double IterativeRoute<dim>::largest_residual() const {
  double worst = 0;
  for (std::size_t i = 0; i < points_.size(); ++i)
    worst = larger(worst, contact_residual(i));
  return worst;
}

// The largest of the terms that nodal forces of the contact are summed from [N].
template <int dim>
double IterativeRoute<dim>::terms_at_contact() const {
  if (points_.empty())
    return 0;
  body::FieldProducts products;
  model_.op.multiply_by_field(state_, products);
  double largest = 0;
  for (std::size_t i = 0; i < points_.size(); ++i)
    for (const std::vector<double> &product : products.of)
      largest = larger(largest, displacement(product, i).norm());
  return largest;
}

// Size of the contact's forces [N], to which their residual is compared.
template <int dim>
double IterativeRoute<dim>::force_size() const {
  double largest = 1e-300;
  for (std::size_t i = 0; i < points_.size(); ++i)
    largest = larger(largest, nodal_force(i).norm());
  return largest;
}

template <int dim>
double IterativeRoute<dim>::accuracy() const {
  return model_.asked.solver.linear_tolerance * terms_at_contact_;
}

template <int dim>
double IterativeRoute<dim>::contact_tolerance() const {
  return 10 * std::max(model_.asked.solver.tolerance, model_.asked.solver.linear_tolerance);
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
    const Tangent beyond = lambda - p.friction.traction(lambda, curvature(i) / weight);
    if (beyond.norm() <= 1e-12 * lambda.norm())
      continue;
    p.slips = changed = true;
    p.slip = beyond * (weight / curvature(i));
  }
  return changed;
}

// Of the rows of each field: u, phi, theta.
template <int dim>
std::array<double, 3> IterativeRoute<dim>::norms(std::span<const double> rows) const {
  std::array<double, 3> norms{};
  for (std::size_t i = 0; i < rows.size(); ++i)
    norms[body::field_of<dim>(i)] += rows[i] * rows[i];
  for (double &norm : norms)
    norm = std::sqrt(norm);
  return norms;
}

// Sizes of the forces, charges and heats that balance in each field's rows: each the norm of what
// one field contributes.
template <int dim>
std::array<double, 3> IterativeRoute<dim>::field_sizes() const {
  body::FieldProducts products;
  model_.op.multiply_by_field(state_, products);
  std::array<double, 3> sizes{};
  for (const std::vector<double> &product : products.of) {
    const std::array<double, 3> of_one = norms(product);
    for (int f = 0; f < 3; ++f)
      sizes[f] = larger(sizes[f], of_one[f]);
  }
  return sizes;
}

// What the residual of the best state that doubles can hold may be, in each field: a few units of
// the last place of every term that is summed.
template <int dim>
std::array<double, 3> IterativeRoute<dim>::round_off() const {
  std::vector<double> terms = model_.op.sizes(model_.step, state_);
  for (std::size_t i = 0; i < terms.size(); ++i)
    terms[i] = is_prescribed_[i] ? 0 : 2e-15 * (terms[i] + std::abs(right_side_[i]));
  return norms(terms);
}

template <int dim>
std::vector<double> IterativeRoute<dim>::newton_residual() const {
  std::vector<double> r = residual_;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const Point<dim> &p = points_[i];
    if (!p.slips)
      continue;
    const Vector friction =
        model_.interface[i].weight * p.admissible.directions * p.friction.gradient(p.slip);
    for (int c = 0; c < dim; ++c)
      r[unknown<dim>(model_.interface[i].node, c)] -= friction[c];
  }
  system_.project(r);
  return r;
}

// Round-off is looked at only where an iteration has gained little, as it costs a product.
template <int dim>
bool IterativeRoute<dim>::body_is_solved() {
  const std::array<double, 3> found = norms(newton_residual()), sizes = field_sizes();
  const double before = body_lack_;
  body_lack_ = 0;
  for (int f = 0; f < 3; ++f)
    if (found[f] > 0)
      body_lack_ =
          larger(body_lack_, found[f] / (model_.asked.solver.linear_tolerance * sizes[f] + 1e-300));
  if (!std::isfinite(found[0] + found[1] + found[2]))
    body_lack_ = std::numeric_limits<double>::infinity();
  // Of a refined solution corrections decide: its residual is what round-off of the state makes.
  if (is_refined() && corrections_fell_ && correction_ > enough)
    return false;
  if (body_lack_ <= 1)
    return true;
  if (body_lack_ < before / 3)
    return false;
  const std::array<double, 3> least = round_off();
  for (int f = 0; f < 3; ++f)
    if (!(found[f] <= std::max(model_.asked.solver.linear_tolerance * sizes[f], least[f])))
      return false;
  return true;
}

template <int dim>
std::vector<krylov::NodeTangent<dim>> IterativeRoute<dim>::held() const {
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
std::vector<krylov::NodeTangent<dim>> IterativeRoute<dim>::tangents() const {
  std::vector<krylov::NodeTangent<dim>> tangents = held();
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const Point<dim> &p = points_[i];
    if (!p.slips)
      continue;
    const auto &d = p.admissible.directions;
    tangents[i].projector = d * d.transpose();
    tangents[i].stiffness =
        model_.interface[i].weight * d * p.friction.hessian(p.slip) * d.transpose();
  }
  return tangents;
}

// False where the linear iteration did not come as far as it was asked to.
template <int dim>
bool IterativeRoute<dim>::add_solution(std::span<const double> residual, double reduction) {
  Stopwatch watch;
  if (is_refined())
    reduction = of_a_correction;
  const krylov::Solved solved = system_.solve(residual, reduction, increment_);
  krylov_iterations_ += solved.iterations;
  krylov_largest_ = std::max(krylov_largest_, solved.iterations);
  linear_seconds_ += watch.lap();
  for (std::size_t i = 0; i < state_.size(); ++i)
    state_[i] += increment_[i];
  if (is_refined()) {
    const double before = correction_;
    correction_ = system_.relative_size(increment_, state_);
    corrections_fell_ = !solved.converged || correction_ < before / 2;
  }
  return solved.converged;
}

template <int dim>
bool IterativeRoute<dim>::newton_step() {
  constexpr double reduction = 1e-2;     // what is left, the next iteration takes
  constexpr std::size_t tiresome = 100;  // linear iterations: friction is stiffer than the body
  system_.set_contact(tangents());
  ++iterations_;
  const std::size_t before = krylov_iterations_;
  return add_solution(newton_residual(), reduction) &&
         (points_.empty() || krylov_iterations_ - before <= tiresome);
}

// Slips as the state has them now; a point whose slip has turned is caught.
template <int dim>
void IterativeRoute<dim>::read_slips() {
  for (std::size_t i = 0; i < points_.size(); ++i) {
    Point<dim> &p = points_[i];
    if (!p.slips)
      continue;
    const Tangent slip =
        p.admissible.directions.transpose() * displacement(state_, i) - p.slip_before;
    if (p.friction.has_kink(slip.size()) && slip.dot(p.slip) <= 0)
      p.slips = false;
    p.slip = slip;
  }
}

// The fast stage: Newton's method on all unknowns, in which body and active set settle together. It
// may cycle; false when it has gained nothing in a while.
template <int dim>
bool IterativeRoute<dim>::find_fast() {
  constexpr int patience = 10, most = 30;
  double least = std::numeric_limits<double>::infinity(), least_of_body = least;
  for (int last_gain = 0; iterations_ == 0 || iterations_ - last_gain < patience;) {
    if (iterations_ > 0) {
      const double worst = largest_residual();
      const bool contact_is_solved = worst <= contact_tolerance() * force_size();
      if (contact_is_solved && body_is_solved())
        return true;
      if (iterations_ >= std::min(most, model_.asked.solver.max_iterations))
        return false;
      if (worst < least || (contact_is_solved && body_lack_ < least_of_body))
        last_gain = iterations_;
      least = std::min(least, worst);
      if (contact_is_solved)
        least_of_body = std::min(least_of_body, body_lack_);
      if (change_active_set()) {
        impose();
        update_residual();
      }
    }
    if (!newton_step())
      return false;
    read_slips();
    impose();
    update_residual();
  }
  return false;
}

// All else with the contact where it is.
template <int dim>
void IterativeRoute<dim>::solve_body() {
  system_.set_contact(held());
  system_.refresh();
  body_lack_ = std::numeric_limits<double>::infinity();
  constexpr int patience = 5;
  double least = body_lack_;
  for (int without_gain = 0; without_gain < patience; ++without_gain) {
    update_residual();
    if (body_is_solved())
      return;
    if (body_lack_ < least / 2) {
      least = body_lack_;
      without_gain = 0;
    }
    add_solution(newton_residual(), std::clamp(0.3 / body_lack_, 1e-6, 1e-1));
  }
  give_up_body();
}

template <int dim>
std::vector<ContactPoint> IterativeRoute<dim>::slip_points() const {
  std::vector<ContactPoint> points;
  Eigen::Index offset = 0;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const Eigen::Index size = points_[i].admissible.directions.cols();
    points.push_back({offset, size, model_.interface[i].weight, points_[i].friction});
    offset += size;
  }
  return points;
}

// Components of a vector over the body along the directions of slip.
template <int dim>
Eigen::VectorXd IterativeRoute<dim>::slips_of(std::span<const double> vector) const {
  std::vector<double> slips;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const Tangent slip = points_[i].admissible.directions.transpose() * displacement(vector, i);
    slips.insert(slips.end(), slip.begin(), slip.end());
  }
  return Eigen::VectorXd::Map(slips.data(), static_cast<Eigen::Index>(slips.size()));
}

// The body starts where it would be if it moved with the contact as it did in the last linear
// solve, as far as the contact does.
template <int dim>
Eigen::VectorXd IterativeRoute<dim>::force(const Eigen::VectorXd &d) {
  Eigen::VectorXd before = slips_of(state_);
  Eigen::Index next = 0;
  for (Point<dim> &p : points_) {
    const Eigen::Index size = p.admissible.directions.cols();
    before.segment(next, size) -= p.slip_before;
    p.slip = d.segment(next, size);
    p.slips = size > 0 && p.friction.is_smooth_at(p.slip);
    next += size;
  }
  const Eigen::VectorXd moved = slips_of(increment_);
  if (const double size = moved.squaredNorm(); size > 0) {
    const double share = moved.dot(d - before) / size;
    for (std::size_t i = 0; i < state_.size(); ++i)
      state_[i] += share * increment_[i];
  }
  impose();
  solve_body();
  return slips_of(residual_);
}

template <int dim>
Eigen::VectorXd IterativeRoute<dim>::direction(const std::vector<bool> &is_smooth,
                                               const std::vector<TangentMatrix> &hessian,
                                               const Eigen::VectorXd &descent) {
  constexpr double reduction = 1e-4;
  std::vector<krylov::NodeTangent<dim>> tangents = held();
  std::vector<double> r = residual_;
  Eigen::Index next = 0;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const auto &d = points_[i].admissible.directions;
    if (is_smooth[i]) {
      // Across a slip that is almost nothing friction is too stiff for the preconditioner.
      const Eigen::SelfAdjointEigenSolver<TangentMatrix> modes(hessian[i]);
      for (Eigen::Index k = 0; k < d.cols(); ++k) {
        if (modes.eigenvalues()[k] > 1e3 * curvature(i))
          continue;
        const Vector mode = d * modes.eigenvectors().col(k);
        tangents[i].projector += mode * mode.transpose();
        tangents[i].stiffness += modes.eigenvalues()[k] * mode * mode.transpose();
      }
      const Vector force = d * descent.segment(next, d.cols());
      std::copy(force.begin(), force.end(), &r[unknown<dim>(model_.interface[i].node, 0)]);
    }
    next += d.cols();
  }
  system_.set_contact(tangents);
  system_.refresh();
  system_.project(r);
  const std::vector<double> state(state_.begin(), state_.end());
  const bool solved = add_solution(r, reduction);
  std::copy(state.begin(), state.end(), state_.begin());
  ++iterations_;
  return solved ? slips_of(increment_) : Eigen::VectorXd();
}

// The safe stage: descent in the programme of the contact, from any start.
template <int dim>
void IterativeRoute<dim>::find_safely() {
  const std::vector<ContactPoint> points = slip_points();
  std::vector<double> curvatures;
  Eigen::VectorXd start(points.empty() ? 0 : points.back().offset + points.back().size);
  for (std::size_t i = 0; i < points.size(); ++i) {
    curvatures.push_back(curvature(i));
    start.segment(points[i].offset, points[i].size) =
        points_[i].slips ? points_[i].slip : Tangent(Tangent::Zero(points[i].size));
  }
  safe_steps_ += start.size() > 0;  // without slips there is only the body to go on with
  std::fill(increment_.begin(), increment_.end(), 0.);
  const int left = model_.asked.solver.max_iterations - iterations_;
  const InterfaceSolution solution = minimise(SlipProgramme{points, curvatures}, *this,
                                              std::move(start), {contact_tolerance(), left});
  if (!solution.converged)
    give_up_contact(solution);
}

template <int dim>
void IterativeRoute<dim>::settle() {
  system_.set_contact(tangents());
  system_.refresh();
  if (!find_fast())
    find_safely();
}

// What the linear iteration answers to the residual cell by cell, over the solution.
template <int dim>
double IterativeRoute<dim>::forward_error() {
  constexpr double reduction = 0.1;
  std::vector<double> correction(state_.size());
  const std::vector<double> assembled = residual_;
  model_.cells.multiply(model_.step, state_, residual_);
  for (std::size_t i = 0; i < residual_.size(); ++i)
    residual_[i] = right_side_[i] - residual_[i];
  system_.set_contact(tangents());
  Stopwatch watch;
  const krylov::Solved solved = system_.solve(newton_residual(), reduction, correction);
  linear_seconds_ += watch.lap();
  residual_ = assembled;
  return solved.converged ? system_.relative_size(correction, state_)
                          : std::numeric_limits<double>::infinity();
}

// The first step that moves anything tells whether refinement helps, and goes on with it if so.
template <int dim>
void IterativeRoute<dim>::measure() {
  measured_ = true;
  double error = is_refined() ? correction_ : forward_error();
  if (!is_refined() && error > worth_refining) {
    system_.refine(model_.cells);
    iterations_ = 0;
    update_residual();
    settle();
    error = correction_;
  }
  accuracy_.forward_error =
      std::isnan(accuracy_.forward_error) ? error : larger(accuracy_.forward_error, error);
}

template <int dim>
StepOutcome IterativeRoute<dim>::advance(double time, std::span<const double> right_side,
                                         std::span<const double> before, std::span<double> state) {
  begin_step(time, right_side, before, state);
  settle();
  const bool moves = std::any_of(state.begin(), state.end(), [](double x) { return x != 0; });
  if (is_refined() || (!measured_ && moves))
    measure();
  accuracy_.backward_error = larger(accuracy_.backward_error,
                                    system_.backward_error(newton_residual(), right_side, state));
  StepOutcome done = outcome();
  for (std::size_t i = 0; i < points_.size(); ++i)
    points_[i].slips = !points_[i].is_held() && done.status[i] == ContactStatus::slip;
  return done;
}

// Of the force q that holds a contact node friction is the law's; of the rest the foundation has
// what is normal, and supports have what is left in prescribed components.
template <int dim>
void IterativeRoute<dim>::share_forces(std::size_t node, StepOutcome &outcome) const {
  const Point<dim> &p = points_[node];
  const double weight = model_.interface[node].weight, r = curvature(node) / weight;
  const auto &d = p.admissible.directions;
  const Tangent lambda = p.friction.traction(trial(node), r);
  Vector q = -nodal_force(node);
  q -= d * (d.transpose() * q + weight * lambda);
  const Tangent borne = -p.admissible.held.transpose() * q / weight;
  const Vector friction =
      -weight * p.admissible.tangent() * p.friction.whole_traction(slip(node), lambda, borne);
  const auto at = dim * static_cast<Eigen::Index>(node);
  outcome.contact_forces.segment<dim>(at) = q - p.admissible.support(q, friction);
  outcome.friction_forces.segment<dim>(at) = friction;
  outcome.status.push_back(p.friction.status(trial(node), r));
}

template <int dim>
StepOutcome IterativeRoute<dim>::outcome() const {
  StepOutcome outcome;
  outcome.newton_iterations = iterations_;
  outcome.contact_forces = Eigen::VectorXd::Zero(dim * static_cast<Eigen::Index>(points_.size()));
  outcome.friction_forces = outcome.contact_forces;
  for (std::size_t i = 0; i < points_.size(); ++i)
    share_forces(i, outcome);
  outcome.residual = relative_to(largest_residual(), force_size());
  return outcome;
}

template <int dim>
void IterativeRoute<dim>::give_up_contact(const InterfaceSolution &solution) const {
  std::string places;
  for (std::size_t i = 0; i < std::min<std::size_t>(solution.unsettled.size(), 3); ++i) {
    const Vector3 &p = model_.interface[solution.unsettled[i]].point;
    places += fmt::format(" ({:g}, {:g}, {:g})", p[0], p[1], p[2]);
  }
  throw SolveError(fmt::format(
      "the contact iteration did not converge at t = {:g} s: residual {:.3g} of the largest force "
      "after {} Newton iterations, wanted {:.3g}; {} points are unsettled, among them{}; raise "
      "solver.max_iterations or solver.linear_tolerance, or take solver.body = \"direct\"",
      time_, solution.residual, iterations_, contact_tolerance(), solution.unsettled.size(),
      places));
}

template <int dim>
void IterativeRoute<dim>::give_up_body() const {
  constexpr std::array<const char *, 3> names{"displacement", "potential", "temperature"};
  const std::array<double, 3> found = norms(newton_residual()), sizes = field_sizes();
  std::string what;
  for (int f = 0; f < 3; ++f)
    if (found[f] > model_.asked.solver.linear_tolerance * sizes[f])
      what += fmt::format("{} {} {:.3g}", what.empty() ? "" : ",", names[f],
                          found[f] / (sizes[f] + 1e-300));
  throw SolveError(fmt::format(
      "the iterative solution of the body's equations did not converge at t = {:g} s; of the "
      "largest contribution to its field's rows there is left:{}, wanted {:.3g} "
      "(solver.linear_tolerance). Slender bodies, thin cells and high contrasts of the materials "
      "make this slow: take solver.body = \"direct\"",
      time_, what, model_.asked.solver.linear_tolerance));
}

template <int dim>
RouteReport IterativeRoute<dim>::report() const {
  RouteReport report;
  report.condense_seconds = system_.set_up_seconds();
  report.substitution_seconds = linear_seconds_;
  report.unknowns = std::count(is_prescribed_.begin(), is_prescribed_.end(), false);
  for (std::size_t unknown = 0; unknown < is_prescribed_.size(); ++unknown)
    report.electric_and_thermal_unknowns +=
        !is_prescribed_[unknown] && unknown % body::Fields<dim>::count >= dim;
  report.krylov_iterations = krylov_iterations_;
  report.krylov_largest = krylov_largest_;
  report.preconditioners = system_.set_ups();
  report.safe_steps = safe_steps_;
  report.backward_error = accuracy_.backward_error;
  report.forward_error = accuracy_.forward_error;
  report.is_refined = is_refined();
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
  numbers.put("route", {double(krylov_iterations_), double(krylov_largest_),
                        accuracy_.backward_error, accuracy_.forward_error, double(measured_),
                        double(is_refined()), linear_seconds_, double(safe_steps_)});
}

template <int dim>
void IterativeRoute<dim>::restore(const output::SavedNumbers &numbers) {
  system_.restore(numbers, points_.size());
  const auto slips = numbers.get("active set", points_.size());
  for (std::size_t i = 0; i < points_.size(); ++i)
    points_[i].slips = slips[i] != 0;
  two_before_.resize(model_.n_unknowns());
  numbers.fill("state before", two_before_);
  const auto route = numbers.get("route", 8);
  krylov_iterations_ = static_cast<std::size_t>(route[0]);
  krylov_largest_ = static_cast<int>(route[1]);
  accuracy_ = {route[2], route[3]};
  measured_ = route[4] != 0;
  if (route[5] != 0)
    system_.refine(model_.cells);
  linear_seconds_ = route[6];
  safe_steps_ = static_cast<int>(route[7]);
}

}  // namespace

template <int dim>
std::unique_ptr<Route> iterative_route(const Model<dim> &model) {
  return std::make_unique<IterativeRoute<dim>>(model);
}

template std::unique_ptr<Route> iterative_route<2>(const Model<2> &);
template std::unique_ptr<Route> iterative_route<3>(const Model<3> &);

}  // namespace tourmaline::solve
