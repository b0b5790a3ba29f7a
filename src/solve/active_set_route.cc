#include "solve/active_set_route.h"

#include <algorithm>
#include <limits>

#include "larger.h"
#include "solve/active_set.h"
#include "solve/iterative_route.h"
#include "solve/slip_descent.h"

namespace tourmaline::solve {

namespace {

using contact::TangentMatrix;
using Eigen::VectorXd;

template <int dim>
class ActiveSetRoute : public IterativeRoute<dim>, private SlipResponse {
 public:
  explicit ActiveSetRoute(const Model<dim> &model)
      : IterativeRoute<dim>(model), contact_(model, this->is_prescribed_) {}

 private:
  using IterativeRoute<dim>::model_;
  using IterativeRoute<dim>::body_;
  using IterativeRoute<dim>::time_;
  using IterativeRoute<dim>::state_;
  using IterativeRoute<dim>::iterations_;
  using IterativeRoute<dim>::so_far_;
  using IterativeRoute<dim>::contact_tolerance;

  void begin_contact(std::span<const double> before) override;
  double terms_at_contact() const;
  std::vector<double> freed(std::vector<double> residual) const override;
  std::vector<double> free_residual() const { return freed(body_.residual()); }
  void impose();

  bool find_fast();
  bool newton_step();
  void find_safely();
  VectorXd force(const VectorXd &d) override;
  VectorXd direction(const std::vector<bool> &is_smooth, const std::vector<TangentMatrix> &hessian,
                     const VectorXd &descent) override;
  double force_size() const override { return contact_.force_size(body_.residual()); }
  double force_accuracy() const override;

  void settle() override;
  void set_contact() override { body_.system().set_contact(contact_.tangents()); }
  StepOutcome outcome() override;
  void save_contact(output::SavedNumbers &numbers) const override { contact_.save(numbers); }
  void restore_contact(const output::SavedNumbers &numbers) override { contact_.restore(numbers); }

  ActiveSet<dim> contact_;
  std::vector<double> carried_;  // storage for `Model::carried`
  double terms_at_contact_ = 0;  // of the step at hand
};

template <int dim>
void ActiveSetRoute<dim>::begin_contact(std::span<const double> before) {
  contact_.begin_step(time_, model_.carried(before, time_, carried_), state_);
  impose();
  terms_at_contact_ = terms_at_contact();
}

// The largest of the terms that nodal forces of the contact are summed from [N].
template <int dim>
double ActiveSetRoute<dim>::terms_at_contact() const {
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
double ActiveSetRoute<dim>::force_accuracy() const {
  return model_.asked.solver.linear_tolerance * terms_at_contact_;
}

// What of a residual of the body Newton's method takes down.
template <int dim>
std::vector<double> ActiveSetRoute<dim>::freed(std::vector<double> residual) const {
  contact_.subtract_friction(residual);
  body_.system().project(residual);
  return residual;
}

template <int dim>
void ActiveSetRoute<dim>::impose() {
  contact_.impose(state_);
  body_.update_residual();
}

template <int dim>
bool ActiveSetRoute<dim>::newton_step() {
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
bool ActiveSetRoute<dim>::find_fast() {
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

// The body starts where it would be if it moved with the contact as it did in the last linear
// solve, as far as the contact does.
template <int dim>
VectorXd ActiveSetRoute<dim>::force(const VectorXd &d) {
  const VectorXd before = contact_.increments_of(state_);
  contact_.set_increments(d);
  const VectorXd moved = contact_.components(body_.increment());
  if (const double size = moved.squaredNorm(); size > 0) {
    const double share = moved.dot(d - before) / size;
    for (std::size_t i = 0; i < state_.size(); ++i)
      state_[i] += share * body_.increment()[i];
  }
  contact_.impose(state_);
  body_.solve_held(time_, contact_.held());
  return contact_.components(body_.residual());
}

template <int dim>
VectorXd ActiveSetRoute<dim>::direction(const std::vector<bool> &is_smooth,
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
void ActiveSetRoute<dim>::find_safely() {
  const std::vector<ContactPoint> points = contact_.programme_points();
  const std::vector<double> curvatures = contact_.curvatures();
  VectorXd start = contact_.increments();
  so_far_.safe_steps += start.size() > 0;  // without slips there is only the body to go on with
  body_.forget_increment();
  const int left = model_.asked.solver.max_iterations - iterations_;
  const InterfaceSolution solution = minimise(SlipProgramme{points, curvatures}, *this,
                                              std::move(start), {contact_tolerance(), left});
  if (!solution.converged)
    this->give_up_contact(solution, [&](std::size_t i) { return model_.interface[i].point; });
}

template <int dim>
void ActiveSetRoute<dim>::settle() {
  body_.system().set_contact(contact_.tangents());
  body_.system().refresh();
  if (!find_fast())
    find_safely();
}

template <int dim>
StepOutcome ActiveSetRoute<dim>::outcome() {
  StepOutcome outcome = contact_.outcome(body_.residual());
  outcome.newton_iterations = iterations_;
  contact_.set_active(outcome.status);
  return outcome;
}

}  // namespace

template <int dim>
std::unique_ptr<Route> active_set_route(const Model<dim> &model) {
  return std::make_unique<ActiveSetRoute<dim>>(model);
}

template std::unique_ptr<Route> active_set_route<2>(const Model<2> &);
template std::unique_ptr<Route> active_set_route<3>(const Model<3> &);

}  // namespace tourmaline::solve
