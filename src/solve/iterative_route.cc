#include "solve/iterative_route.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "larger.h"
#include "solve/active_set.h"
#include "solve/body_equations.h"
#include "solve/first_places.h"
#include "solve/slip_descent.h"
#include "tourmaline/error.h"

namespace tourmaline::solve {

namespace {

using contact::TangentMatrix;
using Eigen::VectorXd;

// Forward errors above it are worth refinement.
constexpr double worth_refining = 1e-7;

template <int dim>
class IterativeRoute : public Route, private SlipResponse {
 public:
  explicit IterativeRoute(const Model<dim> &model);

  StepOutcome advance(double time, std::span<const double> right_side,
                      std::span<const double> before, std::span<double> state) override;
  Accuracy accuracy(std::span<const double>, std::span<const double>,
                    const StepOutcome &) override {
    return accuracy_so_far();
  }
  bool is_refined() const override { return body_.is_refined(); }

 private:
  void begin_step(double time, std::span<const double> right_side, std::span<const double> before,
                  std::span<double> state);
  void predict(std::span<const double> before);
  double terms_at_contact() const;
  double contact_tolerance() const;
  std::vector<double> freed(std::vector<double> residual) const;
  std::vector<double> free_residual() const { return freed(body_.residual()); }
  void impose();

  bool find_fast();
  bool newton_step();
  void find_safely();
  void solve_body();
  VectorXd force(const VectorXd &d) override;
  VectorXd direction(const std::vector<bool> &is_smooth, const std::vector<TangentMatrix> &hessian,
                     const VectorXd &descent) override;
  double force_size() const override { return contact_.force_size(body_.residual()); }
  double accuracy() const override;

  void settle();
  double forward_error();
  void measure();
  [[noreturn]] void give_up_contact(const InterfaceSolution &solution) const;

  void describe(RouteReport &report) const override;
  void refine_again() override { body_.refine(); }
  void save_memory(output::SavedNumbers &numbers) const override;
  void restore_memory(const output::SavedNumbers &numbers) override;

  const Model<dim> &model_;
  std::vector<bool> is_prescribed_;
  ActiveSet<dim> contact_;
  BodyEquations<dim> body_;
  std::vector<double> two_before_;
  std::vector<double> carried_;  // storage for `Model::carried`
  // Of the step at hand:
  double time_ = 0;
  std::span<double> state_;
  int iterations_ = 0;  // Newton iterations
  double terms_at_contact_ = 0;
};

template <int dim>
IterativeRoute<dim>::IterativeRoute(const Model<dim> &model)
    : model_(model),
      is_prescribed_(body::mask_of(model.prescribed, model.n_unknowns())),
      contact_(model, is_prescribed_),
      body_(model, is_prescribed_, so_far_) {
  so_far_.safe_steps = 0;
}

template <int dim>
void IterativeRoute<dim>::begin_step(double time, std::span<const double> right_side,
                                     std::span<const double> before, std::span<double> state) {
  time_ = time;
  state_ = state;
  iterations_ = 0;
  predict(before);
  contact_.begin_step(time, model_.carried(before, time, carried_), state);
  body_.begin_step(right_side, state);
  impose();
  terms_at_contact_ = terms_at_contact();
}

// The change of the last step once more.
template <int dim>
void IterativeRoute<dim>::predict(std::span<const double> before) {
  if (!two_before_.empty())
    for (std::size_t i = 0; i < state_.size(); ++i)
      if (!is_prescribed_[i])
        state_[i] += before[i] - two_before_[i];
  two_before_.assign(before.begin(), before.end());
}

// The largest of the terms that nodal forces of the contact are summed from [N].
template <int dim>
double IterativeRoute<dim>::terms_at_contact() const {
  if (contact_.is_empty())
    return 0;
  body::FieldProducts products;
  model_.op.multiply_by_field(state_, products);
  double largest = 0;
  for (const std::vector<double> &product : products.of)
    largest = larger(largest, contact_.largest_force(product));
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

// What of a residual of the body Newton's method takes down.
template <int dim>
std::vector<double> IterativeRoute<dim>::freed(std::vector<double> residual) const {
  contact_.subtract_friction(residual);
  body_.system().project(residual);
  return residual;
}

template <int dim>
void IterativeRoute<dim>::impose() {
  contact_.impose(state_);
  body_.update_residual();
}

template <int dim>
bool IterativeRoute<dim>::newton_step() {
  constexpr double reduction = 1e-2;     // what is left, the next iteration takes
  constexpr std::size_t tiresome = 100;  // linear iterations: friction is stiffer than the body
  body_.system().set_contact(contact_.tangents());
  ++iterations_;
  const std::size_t before = so_far_.krylov_iterations;
  return body_.correct(free_residual(), reduction) &&
         (contact_.is_empty() || so_far_.krylov_iterations - before <= tiresome);
}

// The fast stage: Newton's method on all unknowns, in which body and active set settle together. It
// may cycle; false when it has gained nothing in a while.
template <int dim>
bool IterativeRoute<dim>::find_fast() {
  constexpr int patience = 10, most = 30;
  double least = std::numeric_limits<double>::infinity(), least_of_body = least;
  for (int last_gain = 0; iterations_ == 0 || iterations_ - last_gain < patience;) {
    if (iterations_ > 0) {
      const double worst = contact_.largest_residual(body_.residual());
      const bool contact_is_solved = worst <= contact_tolerance() * force_size();
      if (contact_is_solved && body_.is_solved(free_residual()))
        return true;
      if (iterations_ >= std::min(most, model_.asked.solver.max_iterations))
        return false;
      if (worst < least || (contact_is_solved && body_.lack() < least_of_body))
        last_gain = iterations_;
      least = std::min(least, worst);
      if (contact_is_solved)
        least_of_body = std::min(least_of_body, body_.lack());
      if (contact_.change(body_.residual()))
        impose();
    }
    if (!newton_step())
      return false;
    contact_.read_slips(state_);
    impose();
  }
  return false;
}

// All else with the contact where it is.
template <int dim>
void IterativeRoute<dim>::solve_body() {
  body_.system().set_contact(contact_.held());
  body_.system().refresh();
  body_.forget_lack();
  constexpr int patience = 5;
  double least = body_.lack();
  for (int without_gain = 0; without_gain < patience; ++without_gain) {
    body_.update_residual();
    if (body_.is_solved(free_residual()))
      return;
    if (body_.lack() < least / 2) {
      least = body_.lack();
      without_gain = 0;
    }
    body_.correct(free_residual(), std::clamp(0.3 / body_.lack(), 1e-6, 1e-1));
  }
  body_.give_up(time_, free_residual());
}

// The body starts where it would be if it moved with the contact as it did in the last linear
// solve, as far as the contact does.
template <int dim>
VectorXd IterativeRoute<dim>::force(const VectorXd &d) {
  const VectorXd before = contact_.increments_of(state_);
  contact_.set_increments(d);
  const VectorXd moved = contact_.components(body_.increment());
  if (const double size = moved.squaredNorm(); size > 0) {
    const double share = moved.dot(d - before) / size;
    for (std::size_t i = 0; i < state_.size(); ++i)
      state_[i] += share * body_.increment()[i];
  }
  contact_.impose(state_);
  solve_body();
  return contact_.components(body_.residual());
}

template <int dim>
VectorXd IterativeRoute<dim>::direction(const std::vector<bool> &is_smooth,
                                        const std::vector<TangentMatrix> &hessian,
                                        const VectorXd &descent) {
  constexpr double reduction = 1e-4;
  std::vector<double> r = body_.residual();
  contact_.put_forces(is_smooth, descent, r);
  body_.system().set_contact(contact_.tangents(is_smooth, hessian));
  body_.system().refresh();
  body_.system().project(r);
  const std::vector<double> state(state_.begin(), state_.end());
  const bool solved = body_.correct(r, reduction);
  std::copy(state.begin(), state.end(), state_.begin());
  ++iterations_;
  return solved ? contact_.components(body_.increment()) : VectorXd();
}

// The safe stage: descent in the programme of the contact, from any start.
template <int dim>
void IterativeRoute<dim>::find_safely() {
  const std::vector<ContactPoint> points = contact_.programme_points();
  const std::vector<double> curvatures = contact_.curvatures();
  VectorXd start = contact_.increments();
  so_far_.safe_steps += start.size() > 0;  // without slips there is only the body to go on with
  body_.forget_increment();
  const int left = model_.asked.solver.max_iterations - iterations_;
  const InterfaceSolution solution = minimise(SlipProgramme{points, curvatures}, *this,
                                              std::move(start), {contact_tolerance(), left});
  if (!solution.converged)
    give_up_contact(solution);
}

template <int dim>
void IterativeRoute<dim>::settle() {
  body_.system().set_contact(contact_.tangents());
  body_.system().refresh();
  if (!find_fast())
    find_safely();
}

template <int dim>
double IterativeRoute<dim>::forward_error() {
  body_.system().set_contact(contact_.tangents());
  return body_.forward_error(freed(body_.residual_by_cells()));
}

// A step that moves a field as never before tells whether refinement helps, and goes on with it if
// so.
template <int dim>
void IterativeRoute<dim>::measure() {
  double error = is_refined() ? body_.last_correction() : forward_error();
  if (!is_refined() && error > worth_refining) {
    body_.refine();
    iterations_ = 0;
    body_.update_residual();
    settle();
    error = body_.last_correction();
  }
  see_forward_error(error);
}

template <int dim>
StepOutcome IterativeRoute<dim>::advance(double time, std::span<const double> right_side,
                                         std::span<const double> before, std::span<double> state) {
  begin_step(time, right_side, before, state);
  settle();
  if (is_refined() || outgrew_measured<dim>(state))
    measure();
  see_backward_error(body_.backward_error(free_residual()));
  StepOutcome outcome = contact_.outcome(body_.residual());
  outcome.newton_iterations = iterations_;
  contact_.set_active(outcome.status);
  return outcome;
}

template <int dim>
void IterativeRoute<dim>::give_up_contact(const InterfaceSolution &solution) const {
  const std::vector<std::size_t> &unsettled = solution.unsettled;
  throw SolveError(fmt::format(
      "the contact iteration did not converge at t = {:g} s: residual {:.3g} of the largest force "
      "after {} Newton iterations, wanted {:.3g}; {} points are unsettled, among them{}; raise "
      "solver.max_iterations or solver.linear_tolerance, or take solver.body = \"direct\"",
      time_, solution.residual, iterations_, contact_tolerance(), unsettled.size(),
      first_places(unsettled.size(),
                   [&](std::size_t i) { return model_.interface[unsettled[i]].point; })));
}

template <int dim>
void IterativeRoute<dim>::describe(RouteReport &report) const {
  report.condense_seconds = body_.system().set_up_seconds();
  report.preconditioners = body_.system().set_ups();
  for (std::size_t i = 0; i < is_prescribed_.size(); ++i)
    if (!is_prescribed_[i]) {
      ++report.unknowns;
      report.electric_and_thermal_unknowns += body::field_of<dim>(i) > 0;
    }
}

template <int dim>
void IterativeRoute<dim>::save_memory(output::SavedNumbers &numbers) const {
  body_.system().save(numbers);
  contact_.save(numbers);
  numbers.put("state before", two_before_);
}

template <int dim>
void IterativeRoute<dim>::restore_memory(const output::SavedNumbers &numbers) {
  body_.system().restore(numbers, model_.interface.size());
  contact_.restore(numbers);
  two_before_.resize(model_.n_unknowns());
  numbers.fill("state before", two_before_);
}

}  // namespace

template <int dim>
std::unique_ptr<Route> iterative_route(const Model<dim> &model) {
  return std::make_unique<IterativeRoute<dim>>(model);
}

template std::unique_ptr<Route> iterative_route<2>(const Model<2> &);
template std::unique_ptr<Route> iterative_route<3>(const Model<3> &);

}  // namespace tourmaline::solve
