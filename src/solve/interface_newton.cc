#include "solve/interface_newton.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "dense/decompositions.h"
#include "larger.h"
#include "solve/force_size.h"
#include "solve/stall.h"
#include "solve/truncation.h"

namespace tourmaline::solve {

namespace {

using contact::Tangent;
using contact::TangentMatrix;
using Eigen::Index;
using Eigen::VectorXd;

constexpr int sweeps_per_iteration = 3;

class Iteration {
 public:
  Iteration(const InterfaceProgramme &programme, VectorXd start, bool is_definite,
            KeptFactor &factor)
      : programme_(programme),
        d_(std::move(start)),
        size_(programme),
        may_be_singular_(!is_definite),
        factor_(factor) {
    for (const ContactPoint &p : programme.points)
      curvature_.push_back(largest_curvature(programme.stiffness, p));
    may_yield_ = solve::may_yield(programme.points);
    update_residual_force();
  }

  void sweep(bool backwards);
  /// Solves one linear system; true when points came to stick on the way, so that the step after it
  /// is another one.
  bool newton_step(bool ahead, double left);
  bool newton_step(bool ahead = false) {
    return newton_step(ahead, is_settling_ ? KeptFactor::for_the_same : KeptFactor::for_the_next);
  }
  void update_residual_force() {
    force_ = programme_.force;
    subtract_product(programme_.stiffness, d_, force_);
  }
  /// What goes before a Newton step.
  void sweeps();

  /// Natural residual |lambda - P(lambda + r d)| of a point, as a nodal force.
  double residual(std::size_t i) const;
  double largest_residual() const;
  double force_size() { return size_.at(d_); }
  bool is_solved(double tolerance);
  /// Whether what systems that were solved in part have left of a solved problem is next to
  /// nothing.
  bool is_polished(double tolerance) {
    return !is_large(d_.size()) || is_solved(next_to_nothing * tolerance);
  }
  InterfaceSolution solution();
  /// Whether the last linear system could be factorised.
  bool is_definite() const { return is_definite_; }
  bool may_yield() const { return may_yield_; }

 private:
  // lambda + r d as a traction; r is the largest curvature of the point's own block of A.
  Tangent trial(std::size_t i) const;
  Tangent friction_force(std::size_t i) const;
  bool is_smooth(const ContactPoint &p) const;
  std::vector<std::size_t> smooth_points() const;
  struct Dissipated {
    double change = 0, round_off = 0;  // [J], the second by 1e-16
  };
  Dissipated dissipated(const VectorXd &next) const;
  Tangent model_place(std::size_t i, bool ahead) const;
  void add_point(std::size_t i, bool ahead, SystemRows &rows, VectorXd &right_side,
                 Index row) const;
  std::optional<VectorXd> newton_direction(const std::vector<std::size_t> &smooth, bool ahead,
                                           double left);
  VectorXd resisted_to(const VectorXd &next) const;
  VectorXd truncated(const VectorXd &direction, double length, Turns turns) const {
    return truncated_step(programme_.points, d_, direction, length, turns);
  }
  struct Change {
    double value = 0, round_off = 0;  // [J]
  };
  Change change_to(const VectorXd &next) const;
  bool descends(const VectorXd &next) const {
    const Change change = change_to(next);
    return change.value <= change.round_off;
  }
  double slope(const VectorXd &direction, const VectorXd &resisted, double length) const;
  double length_to_least(const VectorXd &direction) const;
  void search(const VectorXd &direction, VectorXd &next) const;
  bool shorten(const VectorXd &direction, VectorXd &next) const;
  void go_to(const VectorXd &next);

  const InterfaceProgramme &programme_;
  VectorXd d_;      // slip increments
  VectorXd force_;  // f - A d
  ForceSize size_;
  std::vector<double> curvature_;
  bool may_be_singular_;
  bool may_yield_;  // a normal law has no kink, but a bend where the body begins to touch
  bool is_definite_ = true;
  bool is_settling_ = false;  // the last Newton step was a whole one that no point turned in
  double left_ = 1;           // by the last Newton step, of the largest residual
  int rests_ = 7;  // times that no sweep went before the Newton step; the first time one does
  KeptFactor &factor_;
  std::optional<KeptFactor::Solved> last_solved_;  // the last direction, of a large system
};

Tangent Iteration::trial(std::size_t i) const {
  const ContactPoint &p = programme_.points[i];
  return (force_.segment(p.offset, p.size) + curvature_[i] * p.slip(d_)) / p.weight;
}

Tangent Iteration::friction_force(std::size_t i) const {
  const ContactPoint &p = programme_.points[i];
  return p.weight * p.law.traction(trial(i), curvature_[i] / p.weight);
}

// The point's own problem with all others held, its block of A replaced by its largest eigenvalue:
// exact in one dimension, a descent step in two. A point inside the ball comes out as exactly zero.
void Iteration::sweep(bool backwards) {
  const std::size_t n = programme_.points.size();
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t i = backwards ? n - 1 - k : k;
    const ContactPoint &p = programme_.points[i];
    if (p.size == 0)
      continue;
    const Tangent x = trial(i);
    const Tangent lambda = p.law.traction(x, curvature_[i] / p.weight);
    const Tangent after = (x - lambda) * (p.weight / curvature_[i]);
    const Tangent change = after - p.slip(d_);
    if (change.isZero(0))
      continue;
    p.put(after, d_);
    force_.noalias() -= programme_.stiffness.middleCols(p.offset, p.size) * change;
  }
}

// Where the contact is large a sweep costs as much as a product with A, and Newton's method hardly
// more: one is enough, none of every second time that Newton's method needs no help, and none while
// it converges fast. On a foundation that yields Newton's method with an exact search gets on by
// itself, and sweeps may take it back to where it has been: they come every eighth time.
void Iteration::sweeps() {
  constexpr double fast = 0.03;
  const bool large = is_large(d_.size());
  if (large && is_settling_ && left_ < fast)
    return;
  const int rests = may_yield_ ? 7 : large && is_settling_ ? 1 : 0;
  if (rests_ < rests) {
    ++rests_;
    return;
  }
  rests_ = 0;
  for (int k = 0; k < (large ? 1 : sweeps_per_iteration); ++k)
    sweep(k % 2 == 1);
}

// A point that was stopped at its bend, where the law is smooth but turns within o, sticks for
// Newton's method until a sweep takes it away from there.
bool Iteration::is_smooth(const ContactPoint &p) const {
  const Tangent d = p.slip(d_);
  const auto is_at_bend = [&] { return d.isZero(0) && p.law.has_bend(p.size); };
  return p.size > 0 && p.law.is_smooth_at(d) && !is_at_bend();
}

std::vector<std::size_t> Iteration::smooth_points() const {
  std::vector<std::size_t> smooth;
  for (std::size_t i = 0; i < programme_.points.size(); ++i)
    if (is_smooth(programme_.points[i]))
      smooth.push_back(i);
  return smooth;
}

// Between d_ and `next`. A known slip that is far larger than the change of the free one makes most
// of the dissipation: then the difference of two values would be round-off, and the mean gradient
// is as good as exact.
Iteration::Dissipated Iteration::dissipated(const VectorXd &next) const {
  constexpr double small = 1e-5;  // its third power is round-off
  Dissipated sum;
  for (const ContactPoint &p : programme_.points) {
    if (p.size == 0)
      continue;
    const Tangent before = p.slip(d_), after = p.slip(next);
    const Tangent change = next.segment(p.offset, p.size) - d_.segment(p.offset, p.size);
    if (change.norm() < small * (p.law.held().norm() + p.start.norm()) &&
        p.law.is_smooth_at(before) && p.law.is_smooth_at(after)) {
      sum.change += p.weight / 2 * (p.law.gradient(before) + p.law.gradient(after)).dot(change);
    } else {
      const double value = p.law.potential(before);
      sum.change += p.weight * (p.law.potential(after) - value);
      sum.round_off += p.weight * value;
    }
  }
  return sum;
}

// Where the point's Hessian is taken: at its slip, or, `ahead`, where its own problem would take a
// point on a foundation that yields. That tells a point that stands at the bend on which side of it
// the forces want it to be, and without it steps end at the same bends again and again.
Tangent Iteration::model_place(std::size_t i, bool ahead) const {
  const ContactPoint &p = programme_.points[i];
  if (ahead && p.law.normal() != nullptr && !p.law.has_kink(p.size))
    return (p.weight * trial(i) - friction_force(i)) / curvature_[i];
  return p.slip(d_);
}

// Of the Newton step in the smooth points: the Hessian of their laws beside A.
void Iteration::add_point(std::size_t i, bool ahead, SystemRows &rows, VectorXd &right_side,
                          Index row) const {
  constexpr double slightly = 1e-10;
  const ContactPoint &p = programme_.points[i];
  const Tangent d = p.slip(d_);
  TangentMatrix hessian = p.weight * p.law.hessian(model_place(i, ahead));
  if (may_be_singular_)
    hessian.diagonal() += slightly * programme_.stiffness.diagonal().segment(p.offset, p.size);
  const Tangent descent = force_.segment(p.offset, p.size) - p.weight * p.law.gradient(d);
  rows.add_of_force(row, p.offset, TangentMatrix::Identity(p.size, p.size));
  rows.add_local(row, p.offset, hessian);
  right_side.segment(row, p.size) = descent;
}

// Nothing where the Hessian, positive definite by theory, is not so in its digits.
std::optional<VectorXd> Iteration::newton_direction(const std::vector<std::size_t> &smooth,
                                                    bool ahead, double left) {
  std::vector<Index> unknowns;
  for (const std::size_t i : smooth)
    for (Index c = 0; c < programme_.points[i].size; ++c)
      unknowns.push_back(programme_.points[i].offset + c);
  SystemRows rows;
  VectorXd right_side(static_cast<Index>(unknowns.size()));
  Index row = 0;
  for (const std::size_t i : smooth) {
    add_point(i, ahead, rows, right_side, row);
    row += programme_.points[i].size;
  }
  last_solved_ = factor_.solve_definite(rows.system(std::move(unknowns), d_.size(), d_.size()),
                                        programme_.stiffness, right_side, left);
  return last_solved_ ? std::optional(last_solved_->x) : std::nullopt;
}

VectorXd Iteration::resisted_to(const VectorXd &next) const {
  const VectorXd change = next - d_;
  if (last_solved_ && is_large(change.size()) && next == d_ + last_solved_->x)
    return last_solved_->resisted;
  return symmetric_product(programme_.stiffness, change);
}

// Of the programme's value, and the round-off of its own sum: near the minimum the whole step must
// not be refused for that.
Iteration::Change Iteration::change_to(const VectorXd &next) const {
  const VectorXd change = next - d_;
  const VectorXd resisted = resisted_to(next);
  const double work = force_.dot(change);
  const auto [more, round_off] = dissipated(next);
  return {change.dot(resisted) / 2 - work + more, 1e-14 * (std::abs(work) + round_off)};
}

// Of the value along a direction that leaves points at their kinks where they are.
double Iteration::slope(const VectorXd &direction, const VectorXd &resisted, double length) const {
  double sum = length * direction.dot(resisted) - force_.dot(direction);
  for (const ContactPoint &p : programme_.points) {
    const Tangent along = direction.segment(p.offset, p.size);
    if (!along.isZero(0))
      sum += p.weight * p.law.gradient(p.slip(d_) + length * along).dot(along);
  }
  return sum;
}

// Of a whole step or up to the first kink, where the value is convex and smooth.
double Iteration::length_to_least(const VectorXd &direction) const {
  constexpr int bisections = 40;
  double low = 0, high = 1;
  for (const ContactPoint &p : programme_.points)
    high = std::min(high, length_to_turn(p, d_, direction, Turns::kinks_and_bends));
  const VectorXd resisted = symmetric_product(programme_.stiffness, direction);
  if (slope(direction, resisted, high * (1 - 1e-14)) <= 0)
    return high;
  for (int k = 0; k < bisections; ++k) {
    const double middle = (low + high) / 2;
    (slope(direction, resisted, middle) <= 0 ? low : high) = middle;
  }
  return low;
}

// A foundation that yields answers more stiffly, or no more, beyond the bend where it begins to be
// touched: what a step gains may be next to nothing, though it is not a loss.
void Iteration::search(const VectorXd &direction, VectorXd &next) const {
  constexpr double least_share = 0.1;
  const double promised = -slope(direction, direction, 0) / 2;
  const Change whole = change_to(next);
  if (!(promised > 0) || whole.value <= -least_share * promised)
    return;
  const VectorXd exact = truncated(direction, length_to_least(direction), Turns::kinks_and_bends);
  if (change_to(exact).value < whole.value)
    next = exact;
}

void Iteration::go_to(const VectorXd &next) {
  if (is_large(d_.size()))
    force_ -= resisted_to(next);
  d_ = next;
  if (!is_large(d_.size()))
    update_residual_force();
}

bool Iteration::newton_step(bool ahead, double left) {
  const std::vector<std::size_t> smooth = smooth_points();
  const std::optional<VectorXd> found = newton_direction(smooth, ahead, left);
  is_settling_ = false;
  is_definite_ = found.has_value();
  if (!is_definite_)
    return false;
  VectorXd next = truncated(*found, 1, Turns::kinks);
  if (may_yield_)
    search(*found, next);
  if (!descends(next) && !shorten(*found, next))
    return false;  // round-off is all that is left of the step
  const bool is_whole = next == d_ + *found;
  const double before = largest_residual();
  go_to(next);
  left_ = largest_residual() / before;
  const std::size_t still_smooth = smooth_points().size();
  is_settling_ = is_whole && still_smooth == smooth.size();
  return still_smooth < smooth.size();
}

// Halves the step until the value does not grow, but not below the length at which the first point
// turns: up to there the value falls where points slip on lines. Discs need damping as well.
bool Iteration::shorten(const VectorXd &direction, VectorXd &next) const {
  double first = 1;
  for (const ContactPoint &p : programme_.points)
    first = std::min(first, length_to_turn(p, d_, direction, Turns::kinks_and_bends));
  double length = 1;
  next = truncated(direction, length, Turns::kinks_and_bends);
  while (length > 1e-12 && !descends(next)) {
    length = length > first ? std::max(first, length / 2) : length / 2;
    next = truncated(direction, length, Turns::kinks_and_bends);
  }
  return descends(next);
}

double Iteration::residual(std::size_t i) const {
  const ContactPoint &p = programme_.points[i];
  return (force_.segment(p.offset, p.size) - friction_force(i)).norm();
}

double Iteration::largest_residual() const {
  double largest = 0;
  for (std::size_t i = 0; i < programme_.points.size(); ++i)
    largest = larger(largest, residual(i));
  return largest;
}

// No drift of the updates enters the verdict.
bool Iteration::is_solved(double tolerance) {
  if (!size_.is_within(d_, largest_residual(), tolerance))
    return false;
  if (!is_large(d_.size()))
    return true;
  update_residual_force();
  return size_.is_within(d_, largest_residual(), tolerance);
}

InterfaceSolution Iteration::solution() {
  InterfaceSolution solution;
  solution.increment = d_;
  solution.force = VectorXd::Zero(d_.size());
  for (std::size_t i = 0; i < programme_.points.size(); ++i) {
    const ContactPoint &p = programme_.points[i];
    const Tangent force = friction_force(i);
    solution.force.segment(p.offset, p.size) = force;
    solution.status.push_back(p.law.status(trial(i), curvature_[i] / p.weight));
    solution.residual =
        larger(solution.residual, (force_.segment(p.offset, p.size) - force).norm());
  }
  solution.residual = relative_to(solution.residual, force_size());
  solution.is_definite = is_definite_;
  return solution;
}

// Every point is held in all directions: no unknowns, nothing to solve.
InterfaceSolution nothing_to_slip(const InterfaceProgramme &programme) {
  InterfaceSolution solution;
  for (const ContactPoint &p : programme.points)
    solution.status.push_back(p.law.status(Tangent(0), 1));
  solution.converged = true;
  return solution;
}

}  // namespace

Tangent ContactPoint::slip(const VectorXd &d) const {
  Tangent slip = d.segment(offset, size);
  if (start.size() > 0)
    slip += start;
  return slip;
}

void ContactPoint::put(const Tangent &slip, VectorXd &d) const {
  d.segment(offset, size) = slip;
  if (start.size() > 0)
    d.segment(offset, size) -= start;
}

bool may_yield(const std::vector<ContactPoint> &points) {
  return std::any_of(points.begin(), points.end(), [](const ContactPoint &p) {
    return p.law.normal() != nullptr && !p.law.has_kink(p.size);
  });
}

double largest_curvature(const Eigen::MatrixXd &stiffness, const ContactPoint &p) {
  const TangentMatrix block = stiffness.block(p.offset, p.offset, p.size, p.size);
  if (p.size == 1)
    return block(0, 0);
  return p.size == 0 ? 0 : dense::spectrum(block).values[p.size - 1];
}

InterfaceSolution minimise(const InterfaceProgramme &programme, VectorXd start,
                           const InterfaceSettings &settings) {
  if (programme.force.size() == 0)
    return nothing_to_slip(programme);
  KeptFactor own;
  Iteration iteration(programme, std::move(start), settings.is_definite,
                      settings.factor ? *settings.factor : own);
  int solved = 0;
  bool converged = false;
  for (Creep creep(settings.patience); true;) {
    converged = iteration.is_solved(settings.tolerance);
    if (converged && solved < settings.max_iterations &&
        !iteration.is_polished(settings.tolerance)) {
      iteration.newton_step(false, KeptFactor::for_none);
      ++solved;
      converged = iteration.is_solved(settings.tolerance);
    }
    if (converged || solved == settings.max_iterations || !iteration.is_definite() ||
        creep.see(iteration.largest_residual()))
      break;
    iteration.sweeps();
    bool more = true;
    while (more && solved < settings.max_iterations) {
      more = iteration.newton_step();
      ++solved;
    }
    if (iteration.may_yield() && iteration.is_definite() && solved < settings.max_iterations) {
      iteration.update_residual_force();
      iteration.newton_step(true);
      ++solved;
    }
  }
  InterfaceSolution solution = iteration.solution();
  solution.iterations = solved;
  solution.converged = converged;
  if (converged)
    return solution;
  const double allowed = settings.tolerance * iteration.force_size();
  for (std::size_t i = 0; i < programme.points.size(); ++i)
    if (!(iteration.residual(i) <= allowed))
      solution.unsettled.push_back(i);
  return solution;
}

}  // namespace tourmaline::solve
