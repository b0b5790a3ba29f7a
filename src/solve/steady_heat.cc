#include "solve/steady_heat.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "larger.h"
#include "parallel/ranks.h"
#include "solve/conjugate_gradients.h"
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

template <int dim>
void SteadyHeat<dim>::iterate(double time, const std::vector<double> &heat,
                              std::vector<double> &x) const {
  constexpr double tolerance = 1e-14;
  const auto by_unknown = [&](const std::vector<double> &by_node) {
    std::vector<double> all(x.size(), 0.);
    for (Node node = 0; node < by_node.size(); ++node)
      all[theta(node)] = by_node[node];
    return all;
  };
  const auto product = [&](const std::vector<double> &of) {
    return by_unknown(model_.op.conducted(of));
  };
  FreeUnknowns free{model_.sharing(), std::vector<bool>(x.size(), false), by_unknown(diagonal_),
                    product};
  std::vector<double> residual = by_unknown(heat), terms(x.size(), 0.);
  const std::vector<double> of_x = product(x);
  for (Node node = 0; node < heat.size(); ++node) {
    const std::size_t i = theta(node);
    free.is_free[i] = is_free_[node];
    residual[i] -= of_x[i];
    terms[i] = std::abs(heat[node]) + diagonal_[node] * std::abs(x[i]);
  }
  const double enough = tolerance * tolerance * (free.size_of(terms) + free.size_of(residual));
  const std::size_t most = 20 * model_.sharing().n_all() + 100;
  if (!conjugate_gradients(free, std::move(residual), enough, most, x))
    throw SolveError(
        fmt::format("the steady temperature at t = {:g} did not converge in {} "
                    "iterations; take solver.body = \"direct\"",
                    time, most));
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
