#include "solve/steady_heat.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "larger.h"
#include "parallel/ranks.h"
#include "tourmaline/error.h"

namespace tourmaline::solve {

using body::Fields;
using body::Node;

namespace {

// G as the operator has it, with a step that leaves nothing else in it.
template <int dim>
std::vector<double> conduction_diagonal(const Model<dim> &model) {
  const double step = std::ldexp(1., 100);
  const std::vector<double> with = model.op.diagonal(step), without = model.op.diagonal(0);
  std::vector<double> diagonal(model.body.n_nodes());
  for (Node node = 0; node < diagonal.size(); ++node) {
    const std::size_t i = body::unknown<dim>(node, Fields<dim>::temperature);
    diagonal[node] = (without[i] - with[i]) * model.op.reference_temperature() / step;
  }
  return diagonal;
}

// 2^100 times the time in which heat crosses the cells that it crosses slowest: what is stored is
// then beyond the digits of what is conducted, also over the whole body.
template <int dim>
double long_step(const Model<dim> &model, const std::vector<double> &conduction) {
  const std::vector<double> storage = model.op.diagonal(0);
  double slowest = 0;
  for (Node node = 0; node < conduction.size(); ++node)
    slowest =
        larger(slowest, std::abs(storage[body::unknown<dim>(node, Fields<dim>::temperature)]) *
                            model.op.reference_temperature() / std::max(conduction[node], 1e-300));
  slowest = model.sharing().largest(slowest);
  return std::ldexp(slowest > 0 ? slowest : 1., 100);
}

}  // namespace

template <int dim>
SteadyHeat<dim>::SteadyHeat(const Model<dim> &model, bool iteratively)
    : model_(model),
      diagonal_(conduction_diagonal(model)),
      step_(long_step(model, diagonal_)),
      is_free_(model.body.n_nodes(), true) {
  for (const body::Prescribed &p : model.prescribed)
    if (p.is_given() && p.unknown % n == Fields<dim>::temperature)
      held_.push_back(p);
  keeps_initial_ = !is_held();
  if (keeps_initial_)
    parallel::together([&] { keep_initial(); });
  for (const body::Prescribed &p : held_)
    is_free_[p.unknown / n] = false;
  if (iteratively || std::none_of(is_free_.begin(), is_free_.end(), [](bool free) { return free; }))
    return;
  std::vector<body::Prescribed> prescribed;
  std::vector<bool> is_free(model.n_unknowns(), false);
  for (Node node = 0; node < is_free_.size(); ++node)
    is_free[theta(node)] = is_free_[node];
  for (std::size_t i = 0; i < is_free.size(); ++i)
    if (!is_free[i])
      prescribed.push_back({i, model.body.points()[i / n], 0., ""});
  factorised_ = std::make_unique<condensation::CondensedBody<dim>>(
      model.body, model.op, step_, prescribed, std::vector<std::size_t>{},
      condensation::choice_of(model.asked.solver));
}

// What exchanges heat takes some from a body that is equally warm everywhere.
template <int dim>
bool SteadyHeat<dim>::is_held() const {
  if (model_.sharing().largest(held_.empty() ? 0. : 1.) > 0)
    return true;
  std::vector<double> warm(model_.n_unknowns(), 0.);
  for (Node node = 0; node < diagonal_.size(); ++node)
    warm[theta(node)] = 1;
  const std::vector<double> taken = model_.op.conducted(warm);
  double takes = 0;
  for (Node node = 0; node < diagonal_.size(); ++node)
    if (taken[node] > 1e-9 * diagonal_[node])
      takes = 1;
  return model_.sharing().largest(takes) > 0;
}

template <int dim>
void SteadyHeat<dim>::keep_initial() {
  const casefile::Formula &initial = model_.asked.initial.temperature;
  const std::vector<Vector3> &points = model_.body.points();
  for (Node node = 0; node < diagonal_.size(); ++node) {
    if (initial.value(points[node], 0) != initial.value(points[0], 0))
      throw CaseError(fmt::format(
          "{}: [time] regime = \"static\": no prescribed temperature and no exchange of heat holds "
          "the body, and its initial temperature is not uniform, so that it has no steady one; "
          "give `temperature` on a boundary, or [initial] temperature as a number",
          model_.asked.source));
    held_.push_back({theta(node), points[node], initial, ""});
  }
}

// q by node [W].
template <int dim>
std::vector<double> SteadyHeat<dim>::heat_at(double time) const {
  std::vector<double> loads(model_.n_unknowns(), 0.), heat(model_.body.n_nodes());
  model_.loads.integrate(time, loads);
  for (Node node = 0; node < heat.size(); ++node)
    heat[node] = -loads[theta(node)] * model_.op.reference_temperature() / model_.step;
  return heat;
}

template <int dim>
void SteadyHeat<dim>::require_unwarmed(double time, const std::vector<double> &heat) const {
  double largest = 0;
  for (const double q : heat)
    largest = larger(largest, std::abs(q));
  if (!keeps_initial_ || model_.sharing().largest(largest) == 0)
    return;
  throw CaseError(fmt::format(
      "{}: [time] regime = \"static\": at t = {:g} heat flows into the body, whose temperature "
      "nothing holds, so that it has no steady one; give `temperature` on a boundary",
      model_.asked.source, time));
}

// Conjugate gradients with the diagonal of G: products with G are cheap.
template <int dim>
void SteadyHeat<dim>::iterate(double time, const std::vector<double> &heat,
                              std::vector<double> &x) const {
  constexpr double tolerance = 1e-14;
  const std::size_t size = heat.size();
  std::vector<double> residual(size), direction(size, 0.), of_direction(model_.n_unknowns(), 0.);
  const auto product = [&](const std::vector<double> &state) { return model_.op.conducted(state); };
  const auto projected = [&](std::size_t node, double value) { return is_free_[node] ? value : 0; };
  const auto counts = [&](std::size_t i) { return model_.sharing().counts(static_cast<Node>(i)); };
  const auto size_of = [&](const std::vector<double> &r) {
    double sum = 0;
    for (std::size_t i = 0; i < size; ++i)
      sum += counts(i) && is_free_[i] ? r[i] * r[i] / diagonal_[i] : 0;
    return model_.sharing().sum(sum);
  };
  std::vector<double> of_x = product(x);
  for (std::size_t i = 0; i < size; ++i)
    residual[i] = projected(i, heat[i] - of_x[i]);
  std::vector<double> terms(size);
  for (std::size_t i = 0; i < size; ++i)
    terms[i] = std::abs(heat[i]) + diagonal_[i] * std::abs(x[theta(static_cast<Node>(i))]);
  double rho = size_of(residual);
  const double wanted = tolerance * tolerance * (size_of(terms) + rho);
  const std::size_t most = 20 * model_.sharing().n_all() + 100;
  for (std::size_t k = 0; rho > wanted; ++k) {
    if (k == most)
      throw SolveError(
          fmt::format("the steady temperature at t = {:g} did not converge in {} "
                      "iterations; take solver.body = \"direct\"",
                      time, most));
    for (std::size_t i = 0; i < size; ++i)
      of_direction[theta(static_cast<Node>(i))] = direction[i] +=
          is_free_[i] ? residual[i] / diagonal_[i] : 0;
    const std::vector<double> taken = product(of_direction);
    double curvature = 0;
    for (std::size_t i = 0; i < size; ++i)
      curvature += counts(i) ? projected(i, direction[i] * taken[i]) : 0;
    curvature = model_.sharing().sum(curvature);
    const double along = rho / curvature;
    for (std::size_t i = 0; i < size; ++i) {
      x[theta(static_cast<Node>(i))] += along * direction[i];
      residual[i] -= projected(i, along * taken[i]);
    }
    const double next = size_of(residual), conjugate = next / rho;
    rho = next;
    for (std::size_t i = 0; i < size; ++i)
      direction[i] *= conjugate;
  }
}

template <int dim>
void SteadyHeat<dim>::fill(double time, std::span<double> state) {
  const std::vector<double> heat = heat_at(time);
  require_unwarmed(time, heat);
  std::vector<double> x(state.size(), 0.);
  parallel::together([&] {
    for (const body::Prescribed &p : held_)
      x[p.unknown] = p.value.value(p.point, p.is_given() ? time : 0);
  });
  if (factorised_) {
    std::vector<double> right_side(state.size(), 0.);
    for (Node node = 0; node < heat.size(); ++node)
      right_side[theta(node)] = -step_ / model_.op.reference_temperature() * heat[node];
    factorised_->reduce(right_side, x);
    factorised_->expand(Eigen::VectorXd::Zero(0), x);
  } else {
    iterate(time, heat, x);
  }
  for (Node node = 0; node < heat.size(); ++node)
    state[theta(node)] = x[theta(node)];
}

template class SteadyHeat<2>;
template class SteadyHeat<3>;

}  // namespace tourmaline::solve
