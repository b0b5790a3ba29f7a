#include "solve/iterative_route.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "case/holding.h"
#include "larger.h"
#include "solve/active_set_route.h"
#include "solve/contact_by_solutions.h"
#include "solve/first_places.h"
#include "solve/leaning.h"
#include "stopwatch.h"
#include "tourmaline/error.h"

namespace tourmaline::solve {

namespace {

// Forward errors above it are worth refinement.
constexpr double worth_refined_solutions = 1e-7;

}  // namespace

template <int dim>
IterativeRoute<dim>::IterativeRoute(const Model<dim> &model)
    : model_(model),
      is_prescribed_(body::mask_of(model.prescribed, model.n_unknowns())),
      left_to_contact_(casefile::left_to_contact(model.asked)),
      body_(model, is_prescribed_, so_far_) {
  so_far_.safe_steps = 0;
}

template <int dim>
double IterativeRoute<dim>::contact_tolerance() const {
  return 10 * std::max(model_.asked.solver.tolerance, model_.asked.solver.linear_tolerance);
}

// The state at hand is near what is looked for.
template <int dim>
void IterativeRoute<dim>::take_back() {
  is_predicted_ = true;
  take_contact_back();
}

// How the foundation carries a body that only contact holds along in the step to that time, on
// average.
template <int dim>
typename Model<dim>::Vector IterativeRoute<dim>::carried_to(double time) const {
  typename Model<dim>::Vector moved = Model<dim>::Vector::Zero();
  if (left_to_contact_.empty() || !model_.laws.has_moving_foundation())
    return moved;
  for (const contact::InterfaceNode<dim> &at : model_.interface)
    moved += model_.foundation(at, time) - model_.foundation(at, model_.time_before(time));
  return moved / static_cast<double>(model_.interface.size());
}

// The body is carried along; the rest is the change of the last step once more, at its rate.
template <int dim>
void IterativeRoute<dim>::predict(std::span<const double> before) {
  using Vector = typename Model<dim>::Vector;
  const int n = model_.steps.number(time_);
  const double times = n > 1 ? model_.step / model_.steps.size(n - 1) : 1;
  const bool is_new = !std::exchange(is_predicted_, false), goes_on = !two_before_.empty();
  const Vector now = carried_to(time_),
               last = goes_on ? carried_to(model_.time_before(time_)) : Vector::Zero().eval();
  for (std::size_t i = 0; is_new && i < state_.size(); ++i) {
    if (is_prescribed_[i])
      continue;
    const auto c = static_cast<Eigen::Index>(i % body::Fields<dim>::count);
    state_[i] += c < dim ? now[c] - times * last[c] : 0;
    if (goes_on)
      state_[i] += times * (before[i] - two_before_[i]);
  }
  two_before_.assign(before.begin(), before.end());
}

// Where nothing holds the body, round-off of its stiffness does: loads then move it by so much that
// the round-off of the forces that hold it is a part of them that counts.
template <int dim>
void IterativeRoute<dim>::check_held() const {
  constexpr double counts = 1e-7;
  if (left_to_contact_.empty())
    return;
  const auto [largest, round_off] = body_.nodal_forces();
  if (!(round_off > counts * larger(largest, body_.first_nodal_forces().largest)))
    return;
  // Without any load round-off is all that the forces of a body are that its foundation carries.
  if (const std::string motions = unheld(); !motions.empty())
    let_go(time_, motions);
}

// A step that moves a field as never before tells whether refinement helps, and goes on with it if
// so.
template <int dim>
void IterativeRoute<dim>::measure() {
  const auto forward_error = [&] {
    Stopwatch watch;
    set_contact();
    const double error = body_.forward_error(freed(body_.residual_by_cells()));
    so_far_.estimate_seconds += watch.lap();
    return error;
  };
  double error = is_refined() ? body_.last_correction() : forward_error();
  if (!is_refined() && error > worth_refined_solutions) {
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
  time_ = time;
  state_ = state;
  iterations_ = 0;
  predict(before);
  body_.begin_step(right_side, state);
  begin_contact(before);
  settle();
  check_held();
  if (is_refined() || this->template outgrew_measured<dim>(state))
    measure();
  see_backward_error(body_.backward_error(freed(body_.residual())));
  StepOutcome done = outcome();
  done.backward_error = this->accuracy_so_far().backward_error;
  return done;
}

template <int dim>
void IterativeRoute<dim>::describe(RouteReport &report) const {
  report.condense_seconds += body_.system().set_up_seconds();
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
  save_contact(numbers);
  numbers.put("state before", two_before_);
}

template <int dim>
void IterativeRoute<dim>::restore_memory(const output::SavedNumbers &numbers) {
  two_before_.resize(numbers.size("state before"));
  numbers.fill("state before", two_before_);
  is_predicted_ = false;
  restore_contact(numbers);
  if (!two_before_.empty())  // of a step, whose contact the preconditioner has
    body_.system().restore(numbers, model_.interface.size());
}

template <int dim>
void IterativeRoute<dim>::give_up_contact(const InterfaceSolution &solution,
                                          const std::function<Vector3(std::size_t)> &place) const {
  if (!left_to_contact_.empty()) {
    check_held();
    give_up_leaning(time_, solution, left_to_contact_);
  }
  const std::vector<std::size_t> &unsettled = solution.unsettled;
  throw SolveError(fmt::format(
      "the contact iteration did not converge at t = {:g} s: residual {:.3g} of the largest force "
      "after {} Newton iterations, wanted {:.3g}; {} points are unsettled, among them{}; raise "
      "solver.max_iterations or solver.linear_tolerance, take smaller time steps, or take "
      "solver.body = \"direct\"",
      time_, solution.residual, iterations_, contact_tolerance(), unsettled.size(),
      first_places(unsettled.size(), [&](std::size_t i) { return place(unsettled[i]); })));
}

template class IterativeRoute<2>;
template class IterativeRoute<3>;

template <int dim>
std::unique_ptr<Route> iterative_route(const Model<dim> &model) {
  const bool decides = model.laws.has_normal_unknowns() ||
                       model.laws.crosses_by_state(contact::Crossing::heat) ||
                       model.laws.crosses_by_state(contact::Crossing::charge);
  return decides ? contact_by_solutions(model) : active_set_route(model);
}

template std::unique_ptr<Route> iterative_route<2>(const Model<2> &);
template std::unique_ptr<Route> iterative_route<3>(const Model<3> &);

}  // namespace tourmaline::solve
