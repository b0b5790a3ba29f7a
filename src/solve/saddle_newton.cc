#include "solve/saddle_newton.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "larger.h"

namespace tourmaline::solve {

using contact::AugmentedLagrangian;
using contact::Local;
using contact::Tangent;

namespace {

// Newton iterations without a smaller residual after which the iteration counts as unsettled.
constexpr int patience = 4;
// The method of multipliers has r = 10 times the stiffness of a node: each of its steps then leaves
// about a tenth of the distance to the solution at most.
constexpr double stronger = 10;

// The multiplier that the law answers with; that of u_nu = 0 stays as it is.
Local answer(const AugmentedLagrangian &law, const Local &displacement, const Local &multiplier) {
  Local lambda = multiplier;
  if (law.has_normal && law.normal)
    lambda[0] = law.pressure(displacement, multiplier);
  const Tangent friction = law.friction_traction(displacement, multiplier);
  lambda.tail(friction.size()) = friction;
  return lambda;
}

double dot(const std::vector<double> &a, const std::vector<double> &b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.);
}

}  // namespace

double Verdict::body() const {
  return larger(larger(blocks[0], blocks[1]), blocks[2]);
}

double Verdict::without_law() const {
  return larger(body(), blocks[3]);
}

double Verdict::worst() const {
  return larger(without_law(), blocks[4]);
}

const char *Verdict::worst_name() const {
  const auto is_worse = [](double a, double b) { return !std::isnan(a) && !(b <= a); };
  return names[std::max_element(blocks.begin(), blocks.end(), is_worse) - blocks.begin()];
}

template <int dim>
SaddleNewton<dim>::SaddleNewton(SaddleSystem<dim> &system, const StepData &data,
                                SaddlePoint prediction)
    : system_(system), data_(data), x_(std::move(prediction)) {
  constexpr double little = 1e-3;
  const auto sizes = system_.row_sizes(data_, x_).of_field;
  for (std::size_t field = 0; field < 3; ++field)
    least_sizes_[field] = little * sizes[field];
  least_displacement_ = little * system_.largest_displacement(x_);
}

template <int dim>
bool SaddleNewton<dim>::solve(const SaddleSettings &settings) {
  Eigen::VectorXd multipliers = x_.multipliers;  // the method of multipliers' own sequence
  while (!newton(settings)) {
    if (iterations_ >= settings.max_iterations)
      return false;
    x_.multipliers = multipliers;
    multiplier_step(settings);
    multipliers = x_.multipliers;
  }
  return true;
}

template <int dim>
bool SaddleNewton<dim>::newton(const SaddleSettings &settings) {
  constexpr int most_polishing = 3;
  double smallest = std::numeric_limits<double>::infinity();
  int without_progress = 0, polishing = 0;
  while (true) {
    const Verdict now = verdict();
    const double residual = now.worst();
    if (residual <= settings.tolerance && iterations_ >= settings.least_iterations) {
      const bool gains = residual < smallest / 2 && polishing++ < most_polishing;
      if (!gains || iterations_ >= settings.max_iterations || is_polished(now))
        return true;
    }
    without_progress = residual < smallest ? 0 : without_progress + 1;
    smallest = std::min(smallest, residual);
    if (without_progress == patience || iterations_ == settings.max_iterations)
      return false;
    correct(direction(data_, system_.residual(data_, x_)), 1);
  }
}

// Whether what is left is next to nothing also beside what acts on the body, loads and contact.
template <int dim>
bool SaddleNewton<dim>::is_polished(const Verdict &now) const {
  constexpr double next_to_nothing = 1e-11;
  double acting = system_.largest_rows({{data_.right_side.begin(), data_.right_side.end()}, {}})[0];
  for (std::size_t p = 0; p < data_.laws.size(); ++p)
    acting = larger(acting, system_.points()[p].weight * system_.multiplier(p, x_).norm());
  return now.worst() * now.force_size <= next_to_nothing * acting;
}

template <int dim>
SaddlePoint SaddleNewton<dim>::direction(const StepData &data, const SaddlePoint &residual) {
  system_.factorise(data, x_);
  ++iterations_;
  return system_.increment(residual);  // (44)
}

// Correction step. Multipliers enter the system linearly, so they always move by the whole step.
template <int dim>
void SaddleNewton<dim>::correct(const SaddlePoint &increment, double length) {
  for (std::size_t i = 0; i < x_.body.size(); ++i)
    x_.body[i] += length * increment.body[i];
  x_.multipliers += increment.multipliers;
}

// Minimises the augmented Lagrangian for fixed lambda_tau, as a function of the displacement a
// convex one with a continuous gradient, and then moves lambda_tau to P(lambda_tau + r d). That is
// a proximal step on the dual problem, so a sequence of these converges from any start (R. T.
// Rockafellar, Math. Oper. Res. 1 (1976) 97-116). Newton's iteration before this has solved the
// linear rows of (37), which stay solved whatever the length of a step.
template <int dim>
void SaddleNewton<dim>::multiplier_step(const SaddleSettings &settings) {
  const std::vector<AugmentedLagrangian> laws = laws_with_held_multipliers();
  const StepData held{data_.right_side, data_.before, data_.rest, laws};
  while (judge(held).without_law() > settings.tolerance && iterations_ < settings.max_iterations) {
    const SaddlePoint residual = system_.residual(held, x_);
    const SaddlePoint newton_direction = direction(held, residual);
    correct(newton_direction, length(held, residual, newton_direction));
  }
  for (std::size_t p = 0; p < laws.size(); ++p) {
    const Local lambda = system_.multiplier(p, x_);
    system_.set_multiplier(p, answer(laws[p], system_.displacement(p, x_, data_), lambda), x_);
  }
}

template <int dim>
std::vector<AugmentedLagrangian> SaddleNewton<dim>::laws_with_held_multipliers() const {
  std::vector<AugmentedLagrangian> laws = data_.laws;
  for (std::size_t p = 0; p < laws.size(); ++p) {
    laws[p].is_held = true;
    laws[p].r_slip = stronger * system_.stiffness_at(p);
    if (laws[p].normal)
      laws[p].r_normal = laws[p].r_slip;
  }
  return laws;
}

// Where the augmented Lagrangian is least along the direction, but not beyond the whole step: a
// root of its slope, which grows with the length.
template <int dim>
double SaddleNewton<dim>::length(const StepData &data, const SaddlePoint &residual,
                                 const SaddlePoint &direction) const {
  const double start = dot(residual.body, direction.body);
  const double curvature = dot(system_.body_times(direction.body), direction.body);
  const double contact = contact_power(data, direction, 0);
  const auto slope = [&](double t) {
    return start + t * curvature + contact_power(data, direction, t) - contact;
  };
  constexpr double round_off = 1e-8;
  constexpr int bisections = 40;
  if (slope(1) <= round_off * std::abs(start))
    return 1;
  double low = 0, high = 1;
  for (int k = 0; k < bisections; ++k)
    (slope((low + high) / 2) > 0 ? high : low) = (low + high) / 2;
  return (low + high) / 2;
}

// The tractions of the laws at x + length * direction, times the displacements of the direction
// [J].
template <int dim>
double SaddleNewton<dim>::contact_power(const StepData &data, const SaddlePoint &direction,
                                        double length) const {
  double sum = 0;
  for (std::size_t p = 0; p < data.laws.size(); ++p) {
    const Local change = system_.change(p, direction);
    const Local y = system_.displacement(p, x_, data) + length * change;
    Local traction = data.laws[p].gradient(y, system_.multiplier(p, x_)).traction;
    if (data.laws[p].has_normal && !data.laws[p].normal)
      traction[0] = 0;
    sum += system_.points()[p].weight * traction.dot(change);
  }
  return sum;
}

template <int dim>
double SaddleNewton<dim>::law_residual(std::size_t point) const {
  AugmentedLagrangian natural = data_.laws[point];
  natural.r_slip = natural.r_normal = system_.stiffness_at(point);
  const Local lambda = system_.multiplier(point, x_);
  return system_.points()[point].weight *
         (answer(natural, system_.displacement(point, x_, data_), lambda) - lambda).norm();
}

template <int dim>
Verdict SaddleNewton<dim>::judge(const StepData &data) const {
  Verdict verdict;
  const auto rows = system_.largest_rows(system_.residual(data, x_));
  const auto found = system_.row_sizes(data, x_);
  auto sizes = found.of_field;
  for (std::size_t field = 0; field < 3; ++field)
    sizes[field] = larger(sizes[field], least_sizes_[field]);
  verdict.force_size = sizes[0];
  for (std::size_t field = 0; field < 3; ++field)
    verdict.blocks[field] = relative_to(rows[field], sizes[field]);
  // What is left of the law counts beside the forces around its point, which may be far smaller
  // than those elsewhere; where there are none, beside their round-off.
  constexpr double nothing = 1e-7;
  double gap = 0, law = 0;
  for (std::size_t p = 0; p < data.laws.size(); ++p) {
    if (data.laws[p].has_normal && !data.laws[p].normal)
      gap = larger(gap, std::abs(system_.displacement(p, x_, data)[0]));
    law = larger(
        law, relative_to(law_residual(p), larger(found.at_point[p], nothing * verdict.force_size)));
  }
  verdict.blocks[3] =
      relative_to(gap, larger(system_.largest_displacement(x_), least_displacement_));
  verdict.blocks[4] = law;
  return verdict;
}

template class SaddleNewton<2>;
template class SaddleNewton<3>;

}  // namespace tourmaline::solve
