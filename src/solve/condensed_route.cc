#include "solve/condensed_route.h"

#include <Eigen/Dense>
#include <optional>

#include "body/prescribed.h"
#include "larger.h"
#include "parallel/ranks.h"
#include "solve/condensed_contact.h"
#include "solve/connected_body.h"
#include "solve/judgement.h"
#include "stopwatch.h"

namespace tourmaline::solve {

namespace {

using Eigen::VectorXd;

// Forward errors above it are worth refinement, which costs some twenty substitutions a step.
constexpr double worth_refining = 1e-8;

// The contact's forces there are wanted, so the matrix has rows of them.
template <int dim>
std::size_t prescribed_at_contact(const Model<dim> &model) {
  const std::vector<bool> is_prescribed = body::mask_of(model.prescribed, model.n_unknowns());
  std::size_t n = 0;
  for (const contact::InterfaceNode<dim> &at : model.interface)
    for (int c = 0; c < dim; ++c)
      n += is_prescribed[body::unknown<dim>(at.node, c)];
  return n;
}

template <int dim>
class CondensedRoute : public Route {
 public:
  explicit CondensedRoute(const Model<dim> &model);

  void begin(std::span<const double> settled) override { condensed_.begin(settled); }
  StepOutcome advance(double time, std::span<const double> right_side,
                      std::span<const double> before, std::span<double> state) override;
  Accuracy accuracy(std::span<const double> right_side, std::span<const double> state,
                    const StepOutcome &outcome) override;
  void take_back() override {
    condensed_.take_back();
    take_contact_back();
  }
  bool is_refined() const override { return condensed_.body().is_refined(); }
  void go_on_from(const VectorXd &accumulated_slip) override {
    contact_->set_accumulated_slip(accumulated_slip);
  }

 private:
  void take_contact_back();
  double error_of_contact() const { return contact_ ? contact_->error() : 0; }
  void refine();
  void measure(std::span<const double> right_side, std::span<const double> state,
               const StepOutcome &outcome);
  StepOutcome solve(double time, std::span<const double> right_side, std::span<const double> before,
                    std::span<double> state);

  void describe(RouteReport &report) const override;
  void refine_again() override { refine(); }
  void save_memory(output::SavedNumbers &numbers) const override;
  void restore_memory(const output::SavedNumbers &numbers) override;
  void forget_matrices() override {
    if (contact_)
      contact_->forget_matrices();
  }

  const Model<dim> &model_;
  ConnectedBody<dim> condensed_;
  std::optional<CondensedContact<dim>> contact_;
  double condense_seconds_ = 0;
};

template <int dim>
CondensedRoute<dim>::CondensedRoute(const Model<dim> &model) : model_(model), condensed_(model) {
  Stopwatch watch;
  if (!model.interface.empty())
    contact_.emplace(model, condensed_);
  condense_seconds_ = watch.lap();
  if (!(error_of_contact() <= worth_refining))
    refine();
}

template <int dim>
void CondensedRoute<dim>::refine() {
  Stopwatch watch;
  condensed_.refine();
  if (contact_)
    contact_->condense();
  condense_seconds_ += watch.lap();
}

template <int dim>
StepOutcome CondensedRoute<dim>::solve(double time, std::span<const double> right_side,
                                       std::span<const double> before, std::span<double> state) {
  Stopwatch watch;
  const VectorXd s = condensed_.reduce(time, right_side, state);
  so_far_.substitution_seconds += watch.lap();
  StepOutcome outcome;
  VectorXd c = s;
  if (contact_)
    outcome = contact_->advance(time, s, before, state, c);
  so_far_.contact_seconds += watch.lap();
  parallel::from_first(std::span(c.data(), static_cast<std::size_t>(c.size())));
  condensed_.expand(c, state);
  so_far_.substitution_seconds += watch.lap();
  return outcome;
}

// A step that moves a field as never before tells whether refinement helps, and is taken again if
// so.
template <int dim>
StepOutcome CondensedRoute<dim>::advance(double time, std::span<const double> right_side,
                                         std::span<const double> before, std::span<double> state) {
  const VectorXd start = contact_ ? contact_->last_increment() : VectorXd();
  StepOutcome outcome = solve(time, right_side, before, state);
  if (is_refined() || outgrew_measured<dim>(model_.sharing(), state)) {
    measure(right_side, state, outcome);
    if (is_refined() || !(so_far_.forward_error > worth_refining))
      return outcome;
    refine();
    if (contact_)
      contact_->start_from(start);
    take_contact_back();
    outcome = solve(time, right_side, before, state);
    forget_errors();
    measure(right_side, state, outcome);
  }
  return outcome;
}

template <int dim>
void CondensedRoute<dim>::take_contact_back() {
  if (contact_)
    contact_->take_back();
}

template <int dim>
void CondensedRoute<dim>::measure(std::span<const double> right_side, std::span<const double> state,
                                  const StepOutcome &outcome) {
  Stopwatch watch;
  const Accuracy now = accuracy(right_side, state, outcome);
  so_far_.estimate_seconds += watch.lap();
  see_backward_error(now.backward_error);
  see_forward_error(now.forward_error);
}

template <int dim>
Accuracy CondensedRoute<dim>::accuracy(std::span<const double> right_side,
                                       std::span<const double> state, const StepOutcome &outcome) {
  condensation::CondensedBody<dim> &body = condensed_.body();
  const double inside = body.is_refined() ? body.left_by_refinement()
                                          : body.forward_error(model_.cells, right_side, state);
  const VectorXd q = contact_ ? contact_->reactions(outcome) : VectorXd();
  return {body.backward_error(right_side, state, q), larger(inside, error_of_contact())};
}

template <int dim>
void CondensedRoute<dim>::describe(RouteReport &report) const {
  add_factorisation(condensed_.body().statistics(), report);
  report.factorisations = 1;
  report.condense_seconds += condense_seconds_;
  report.unknowns = condensed_.body().n_unknowns() - prescribed_at_contact(model_);
  report.electric_and_thermal_unknowns = condensed_.body().n_electric_and_thermal();
  report.negative_pivots = condensed_.body().statistics().negative_pivots;
  if (contact_)
    report.negative_pivots += contact_->negative_pivots();
}

template <int dim>
void CondensedRoute<dim>::save_memory(output::SavedNumbers &numbers) const {
  condensed_.save(numbers);
  if (contact_)
    contact_->save(numbers);
}

template <int dim>
void CondensedRoute<dim>::restore_memory(const output::SavedNumbers &numbers) {
  condensed_.restore(numbers);
  if (contact_)
    contact_->restore(numbers);
}

}  // namespace

template <int dim>
std::unique_ptr<Route> condensed_route(const Model<dim> &model) {
  return std::make_unique<CondensedRoute<dim>>(model);
}

template std::unique_ptr<Route> condensed_route<2>(const Model<2> &);
template std::unique_ptr<Route> condensed_route<3>(const Model<3> &);

}  // namespace tourmaline::solve
