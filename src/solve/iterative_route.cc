#include "solve/iterative_route.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "case/holding.h"
#include "solve/body_equations.h"
#include "solve/contact_by_solutions.h"
#include "solve/first_places.h"
#include "solve/leaning.h"
#include "stopwatch.h"
#include "tourmaline/error.h"

namespace tourmaline::solve {

namespace {

using Eigen::VectorXd;

// Forward errors above it are worth refinement.
constexpr double worth_refined_solutions = 1e-7;

// Displacements, then potentials and temperatures.
template <int dim>
std::array<std::size_t, 2> free_unknowns(const Model<dim> &model,
                                         const std::vector<bool> &is_prescribed) {
  std::array<double, 2> count{};
  for (std::size_t i = 0; i < is_prescribed.size(); ++i)
    if (!is_prescribed[i] && model.counts(i))
      ++count[body::field_of<dim>(i) > 0 ? 1 : 0];
  model.sharing().sum(count);
  return {static_cast<std::size_t>(count[0]), static_cast<std::size_t>(count[1])};
}

template <int dim>
class IterativeRoute : public Route {
 public:
  explicit IterativeRoute(const Model<dim> &model);

  StepOutcome advance(double time, std::span<const double> right_side,
                      std::span<const double> before, std::span<double> state) override;
  void take_back() override;
  Accuracy accuracy(std::span<const double>, std::span<const double>,
                    const StepOutcome &) override {
    return accuracy_so_far();
  }
  bool is_refined() const override { return body_.is_refined(); }
  VectorXd accumulated_slip() const override { return contact_.accumulated_slip(); }

 private:
  typename Model<dim>::Vector carried_to(double time) const;
  void predict(std::span<const double> before);
  void settle();
  void measure();
  double forward_error();
  [[noreturn]] void give_up_contact() const;
  void describe(RouteReport &report) const override;
  void refine_again() override { body_.refine(); }
  void save_memory(output::SavedNumbers &numbers) const override;
  void restore_memory(const output::SavedNumbers &numbers) override;

  const Model<dim> &model_;
  const std::vector<bool> is_prescribed_;
  const std::array<std::size_t, 2> unknowns_;  // that are solved for: of u, of phi and theta
  const std::string left_to_contact_;          // rigid motions
  const double contact_tolerance_;
  BodyEquations<dim> body_;
  ContactBySolutions<dim> contact_;
  std::vector<double> two_before_;
  bool is_predicted_ = false;  // the state that the next step is taken from
  // Of the step at hand:
  double time_ = 0;
  std::span<double> state_;
};

template <int dim>
IterativeRoute<dim>::IterativeRoute(const Model<dim> &model)
    : model_(model),
      is_prescribed_(body::mask_of(model.prescribed, model.n_unknowns())),
      unknowns_(free_unknowns(model, is_prescribed_)),
      left_to_contact_(resisted_by_contact_alone(model)),
      contact_tolerance_(
          10 * std::max(model.asked.solver.tolerance, model.asked.solver.linear_tolerance)),
      body_(model, is_prescribed_, so_far_),
      contact_(model, is_prescribed_, body_, so_far_, !left_to_contact_.empty(), contact_tolerance_,
               [this](const char *what, int done, int all) { this->say(what, done, all); }) {}

// The state at hand is near what is looked for.
template <int dim>
void IterativeRoute<dim>::take_back() {
  is_predicted_ = true;
  contact_.take_back();
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

template <int dim>
void IterativeRoute<dim>::settle() {
  if (!contact_.settle())
    give_up_contact();
}

template <int dim>
double IterativeRoute<dim>::forward_error() {
  Stopwatch watch;
  const double error = contact_.forward_error();
  so_far_.estimate_seconds += watch.lap();
  return error;
}

// A step that moves a field as never before tells whether refinement helps, and goes on with it if
// so.
template <int dim>
void IterativeRoute<dim>::measure() {
  double error = forward_error();
  if (!is_refined() && error > worth_refined_solutions) {
    body_.refine();
    body_.update_residual();
    settle();
    error = forward_error();
  }
  see_forward_error(error);
}

template <int dim>
StepOutcome IterativeRoute<dim>::advance(double time, std::span<const double> right_side,
                                         std::span<const double> before, std::span<double> state) {
  time_ = time;
  state_ = state;
  predict(before);
  body_.begin_step(right_side, state);
  contact_.begin_step(time, before, state);
  settle();
  if (is_refined() || this->template outgrew_measured<dim>(model_.sharing(), state))
    measure();
  see_backward_error(body_.backward_error(contact_.freed(body_.residual())));
  StepOutcome done = contact_.outcome();
  done.backward_error = this->accuracy_so_far().backward_error;
  return done;
}

template <int dim>
void IterativeRoute<dim>::describe(RouteReport &report) const {
  report.condense_seconds += body_.system().set_up_seconds();
  report.is_iterative = true;
  report.preconditioners += body_.system().set_ups();
  report.unknowns = unknowns_[0] + unknowns_[1];
  report.electric_and_thermal_unknowns = unknowns_[1];
}

template <int dim>
void IterativeRoute<dim>::save_memory(output::SavedNumbers &numbers) const {
  body_.system().save(numbers);
  contact_.save(numbers);
  numbers.put_field("state before", two_before_);
}

template <int dim>
void IterativeRoute<dim>::restore_memory(const output::SavedNumbers &numbers) {
  two_before_.resize(numbers.size("state before"));
  numbers.fill("state before", two_before_);
  is_predicted_ = false;
  contact_.restore(numbers);
  if (!two_before_.empty())  // of a step, whose contact the preconditioner has
    body_.system().restore(numbers, model_.interface.size());
}

template <int dim>
void IterativeRoute<dim>::give_up_contact() const {
  const InterfaceSolution &solution = contact_.solution();
  if (!left_to_contact_.empty()) {
    const std::string motions = contact_.carried_off();
    if (!motions.empty() && is_conclusive(model_, solution))
      let_go(time_, motions);
    give_up_leaning(time_, solution, left_to_contact_);
  }
  const std::vector<std::size_t> &unsettled = solution.unsettled;
  const std::string where =
      unsettled.empty() ? ""
                        : fmt::format("; {} points are unsettled, among them{}", unsettled.size(),
                                      first_places(unsettled.size(), [&](std::size_t i) {
                                        return contact_.place(unsettled[i]);
                                      }));
  throw UnsettledStep(fmt::format(
      "the contact iteration did not converge at t = {:g} s: residual {:.3g} of the largest force "
      "after {} Newton iterations, wanted {:.3g}{}; raise "
      "solver.max_iterations or solver.linear_tolerance, take smaller time steps, or take "
      "solver.body = \"direct\"",
      time_, solution.residual, contact_.iterations(), contact_tolerance_, where));
}

}  // namespace

template <int dim>
std::unique_ptr<Route> iterative_route(const Model<dim> &model) {
  return std::make_unique<IterativeRoute<dim>>(model);
}

template std::unique_ptr<Route> iterative_route<2>(const Model<2> &);
template std::unique_ptr<Route> iterative_route<3>(const Model<3> &);

}  // namespace tourmaline::solve
