#include "solve/body_equations.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "larger.h"
#include "stopwatch.h"
#include "tourmaline/error.h"

namespace tourmaline::solve {

namespace {

constexpr double of_a_correction = 1e-12;  // reduction of the residual, once refined
constexpr double of_round_off = 2e-15;     // of the terms of a row
constexpr double enough = 1e-15;           // a correction that changes no digit

// Of the rows of each field: u, phi, theta.
template <int dim>
std::array<double, 3> norms(const Model<dim> &model, std::span<const double> rows) {
  std::array<double, 3> norms{};
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (model.counts(i))
      norms[body::field_of<dim>(i)] += rows[i] * rows[i];
  model.sharing().sum(norms);
  for (double &norm : norms)
    norm = std::sqrt(norm);
  return norms;
}

}  // namespace

template <int dim>
BodyEquations<dim>::BodyEquations(const Model<dim> &model, const std::vector<bool> &is_prescribed,
                                  RouteReport &count)
    : model_(model),
      is_prescribed_(is_prescribed),
      count_(count),
      system_(model.op, model.step, model.body.points(), model.prescribed),
      residual_(model.n_unknowns()),
      increment_(model.n_unknowns()) {}

template <int dim>
void BodyEquations<dim>::begin_step(std::span<const double> right_side, std::span<double> state) {
  loads_ = right_side;
  right_side_.assign(right_side.begin(), right_side.end());
  state_ = state;
  begin_corrections();
  forget_increment();
  first_nodal_forces_ = nodal_forces();
  first_round_off_ = round_off({});
}

template <int dim>
void BodyEquations<dim>::begin_corrections() {
  lack_ = correction_ = std::numeric_limits<double>::infinity();
  corrections_fall_ = true;
}

template <int dim>
void BodyEquations<dim>::forget_increment() {
  std::fill(increment_.begin(), increment_.end(), 0.);
}

template <int dim>
void BodyEquations<dim>::hold(const HeldExchanges<dim> &exchange) {
  right_side_.assign(loads_.begin(), loads_.end());
  exchange.add_rests(right_side_);
  slopes_.clear();
  std::vector<Eigen::Vector2d> crossing(model_.interface.size(), Eigen::Vector2d::Zero());
  for (std::size_t k = 0; k < exchange.sites().size(); ++k) {
    const ExchangeSite &site = exchange.sites()[k];
    const double slope = exchange.slopes()[static_cast<Eigen::Index>(k)];
    slopes_.emplace_back(site.unknown, slope);
    crossing[site.node][body::field_of<dim>(site.unknown) - 1] = slope;
  }
  system_.set_crossing(crossing);
}

template <int dim>
std::vector<double> BodyEquations<dim>::left(std::vector<double> product) const {
  for (const auto &[unknown, slope] : slopes_)
    product[unknown] -= slope * state_[unknown];
  for (std::size_t i = 0; i < product.size(); ++i)
    product[i] = right_side_[i] - product[i];
  return product;
}

template <int dim>
void BodyEquations<dim>::update_residual() {
  residual_ = left(model_.product(state_, is_refined()));
}

template <int dim>
std::vector<double> BodyEquations<dim>::residual_by_cells() const {
  return left(model_.product(state_, true));
}

// Sizes of the forces, charges and heats that balance in each field's rows: each the norm of what
// one field contributes.
template <int dim>
std::array<double, 3> BodyEquations<dim>::field_sizes() const {
  body::FieldProducts products;
  model_.op.multiply_by_field(state_, products);
  std::array<double, 3> sizes{};
  for (const std::vector<double> &product : products.of) {
    const std::array<double, 3> of_one = norms(model_, product);
    for (int f = 0; f < 3; ++f)
      sizes[f] = larger(sizes[f], of_one[f]);
  }
  return sizes;
}

template <int dim>
typename BodyEquations<dim>::NodalForces BodyEquations<dim>::nodal_forces() const {
  using Vector = Eigen::Matrix<double, dim, 1>;
  constexpr int n = body::Fields<dim>::count;
  body::FieldProducts products;
  model_.op.multiply_by_field(state_, products);
  NodalForces forces;
  for (const std::vector<double> &of_one : products.of)
    for (std::size_t i = 0; i < of_one.size(); i += n)
      forces.largest = larger(forces.largest, Vector::Map(&of_one[i]).norm());
  forces.largest = model_.sharing().largest(forces.largest);
  forces.round_off = of_round_off * norms(model_, model_.op.sizes(model_.step, state_))[0];
  return forces;
}

// What the residual of the best state that doubles can hold may be, in each field: a few units of
// the last place of every term that is summed.
template <int dim>
std::array<double, 3> BodyEquations<dim>::round_off(std::span<const double> right_side) const {
  std::vector<double> terms = model_.op.sizes(model_.step, state_);
  for (std::size_t i = 0; i < terms.size(); ++i)
    terms[i] = is_prescribed_[i]
                   ? 0
                   : of_round_off * (terms[i] + (right_side.empty() ? 0 : std::abs(right_side[i])));
  return norms(model_, terms);
}

template <int dim>
bool BodyEquations<dim>::corrections_go_on() const {
  return is_refined() && corrections_fall_ && correction_ > enough;
}

// Round-off is looked at only where an iteration has gained little, as it costs a product. Of a
// refined solution corrections decide: its residual is what round-off of the state makes.
template <int dim>
bool BodyEquations<dim>::is_solved(std::span<const double> free_residual) {
  const double tolerance = model_.asked.solver.linear_tolerance;
  const std::array<double, 3> found = norms(model_, free_residual), sizes = field_sizes();
  const double before = lack_;
  lack_ = 0;
  for (int f = 0; f < 3; ++f)
    if (found[f] > 0)
      lack_ = larger(lack_, found[f] / (tolerance * sizes[f] + 1e-300));
  if (!std::isfinite(found[0] + found[1] + found[2]))
    lack_ = std::numeric_limits<double>::infinity();
  if (corrections_go_on())
    return false;
  if (lack_ <= 1)
    return true;
  if (lack_ < before / 3)
    return false;
  const std::array<double, 3> least = round_off(right_side_);
  for (int f = 0; f < 3; ++f)
    if (!(found[f] <= std::max({tolerance * sizes[f], least[f], first_round_off_[f]})))
      return false;
  return true;
}

template <int dim>
bool BodyEquations<dim>::solve(std::span<const double> free_residual, double reduction) {
  Stopwatch watch;
  if (is_refined())
    reduction = of_a_correction;
  const krylov::Solved solved = system_.solve(free_residual, reduction, increment_);
  count_.krylov_iterations += solved.iterations;
  count_.krylov_largest = std::max(count_.krylov_largest, solved.iterations);
  count_.substitution_seconds += watch.lap();
  return solved.converged;
}

template <int dim>
bool BodyEquations<dim>::correct(std::span<const double> free_residual, double reduction) {
  const bool is_solved = solve(free_residual, reduction);
  for (std::size_t i = 0; i < state_.size(); ++i)
    state_[i] += increment_[i];
  if (is_refined()) {
    const double before = correction_;
    correction_ = system_.relative_size(increment_, state_);
    corrections_fall_ = !is_solved || correction_ < before / 2;
  }
  return is_solved;
}

template <int dim>
void BodyEquations<dim>::solve_held(double time,
                                    const std::vector<krylov::NodeTangent<dim>> &held) {
  system_.set_contact(held);
  system_.refresh();
  begin_corrections();
  const auto free_residual = [&] {
    std::vector<double> residual = residual_;
    system_.project(residual);
    return residual;
  };
  constexpr int patience = 5;
  double least = lack_;
  for (int without_gain = 0; without_gain < patience; ++without_gain) {
    update_residual();
    if (is_solved(free_residual()))
      return;
    if (lack_ < least / 2 || corrections_go_on()) {
      least = std::min(least, lack_);
      without_gain = 0;
    }
    correct(free_residual(), std::clamp(0.3 / lack_, 1e-6, 1e-1));
  }
  give_up(time, free_residual());
}

template <int dim>
void BodyEquations<dim>::refine() {
  system_.refine(model_.cells);
}

template <int dim>
double BodyEquations<dim>::forward_error(std::span<const double> free_residual) {
  constexpr double reduction = 0.1;
  std::vector<double> correction(state_.size());
  const krylov::Solved solved = system_.solve(free_residual, reduction, correction);
  return solved.converged ? system_.relative_size(correction, state_)
                          : std::numeric_limits<double>::infinity();
}

template <int dim>
double BodyEquations<dim>::backward_error(std::span<const double> free_residual) const {
  return system_.backward_error(free_residual, right_side_, state_);
}

// With what is left in each field.
template <int dim>
void BodyEquations<dim>::give_up(double time, std::span<const double> free_residual) const {
  constexpr std::array<const char *, 3> names{"displacement", "potential", "temperature"};
  const double tolerance = model_.asked.solver.linear_tolerance;
  const std::array<double, 3> found = norms(model_, free_residual), sizes = field_sizes();
  std::string what;
  for (int f = 0; f < 3; ++f)
    if (!(found[f] <= tolerance * sizes[f]))
      what += fmt::format("{} {} {:.3g}", what.empty() ? "" : ",", names[f],
                          found[f] / (sizes[f] + 1e-300));
  throw SolveError(fmt::format(
      "the iterative solution of the body's equations did not converge at t = {:g} s; of the "
      "largest contribution to its field's rows there is left:{}, wanted {:.3g} "
      "(solver.linear_tolerance). Slender bodies, thin cells and high contrasts of the materials "
      "make this slow: take solver.body = \"direct\"",
      time, what, tolerance));
}

template class BodyEquations<2>;
template class BodyEquations<3>;

}  // namespace tourmaline::solve
