#include "run/evolution.h"

#include <utility>

#include "body/prescribed.h"
#include "case/electrodes.h"
#include "parallel/ranks.h"
#include "run/start_state.h"
#include "run/step_check.h"
#include "solve/settling.h"
#include "stopwatch.h"

namespace tourmaline::run {

template <int dim>
Evolution<dim>::Evolution(solve::Model<dim> &model)
    : model_(model),
      leaked_(model),
      motion_(model),
      foundations_(model),
      state_(start_state(model)) {}

template <int dim>
void Evolution<dim>::make_ready(bool iterative, output::Progress &progress, int first) {
  if (model_.asked.time.is_static() && model_.asked.model.thermal)
    steady_heat_.emplace(model_, iterative);
  if (first == 1)
    settle(iterative);
  route_.emplace(model_, iterative, progress, first);
  const bool eliminates_them = !iterative && model_.asked.solver.method == "condensed";
  if (!eliminates_them && !casefile::all_voltages_given(model_.asked))
    electrodes_.emplace(model_);
}

// Before there is a route, whose system would take its memory beside the one that is solved here.
template <int dim>
void Evolution<dim>::settle(bool iterative) {
  foundations_.begin(state_);
  if (motion_.is_inertial())
    solve::settle(model_, iterative, foundations_, state_);
}

template <int dim>
void Evolution<dim>::begin() {
  if (motion_.is_inertial()) {
    route_->route().begin(state_);
    if (electrodes_)
      electrodes_->begin(state_);
  }
  motion_.begin(state_);
}

template <int dim>
void Evolution<dim>::prescribe(double time, std::vector<double> &state) {
  parallel::together([&] {
    for (const body::Prescribed &p : model_.prescribed)
      state[p.unknown] = p.value.value(p.point, time);
  });
  if (electrodes_)
    electrodes_->prescribe(state);
  if (steady_heat_)
    steady_heat_->fill(time, state);
}

template <int dim>
void Evolution<dim>::sum_right_side(TakenStep &step) {
  const double time = model_.time(step.n);
  step.loads.assign(model_.n_unknowns(), 0.);
  model_.add_loads(time, step.loads);
  parallel::together([&] { StepCheck(step.n, time).loads(dim, model_.body.points(), step.loads); });
  step.right_side = step.loads;
  leaked_.add_to(step.right_side);
  add_remembered(step.right_side);
  motion_.add_history(time, state_, step.state, step.right_side);
}

template <int dim>
void Evolution<dim>::add_remembered(std::vector<double> &right_side) {
  const bool by_cells = route_->route().is_refined();
  if (remembered_.heats.empty() || remembered_.by_cells != by_cells)
    remember(model_.products_by_field(state_, by_cells), by_cells);
  for (std::size_t i = 0; i < right_side.size(); ++i)
    right_side[i] += remembered_.heats[i];
}

// Again with other potentials of foundations or electrodes, until they have the charges that their
// circuits say. A case that looks for both has one of them eliminated (`check_electrodes`).
template <int dim>
void Evolution<dim>::advance(TakenStep &step) {
  const double time = model_.time(step.n);
  step.state = state_;
  for (;;) {
    prescribe(time, step.state);
    sum_right_side(step);
    step.outcome = route_->advance(step.n, step.right_side, state_, step.state);
    if (foundations_.settle(time, step.state, step.outcome) &&
        (!electrodes_ || electrodes_->settle(time, step.right_side, step.state, step.outcome)))
      return;
    route_->route().take_back();
  }
}

template <int dim>
TakenStep Evolution<dim>::take(int n) {
  Stopwatch watch;
  route_->begin_step(n);
  TakenStep step;
  step.n = n;
  step.before = state_;
  advance(step);
  leaked_.describe(step.outcome);
  motion_.end_step(state_, step.state);
  step.outcome.rates = motion_.record();
  state_ = step.state;
  remembered_ = {};
  last_ = n;
  leaked_.end_step(model_.time(n), state_);
  step.seconds = watch.lap();
  return step;
}

template <int dim>
void Evolution<dim>::see_balanced(int n, const solve::BalancedState<dim> &end) {
  if (n == last_)
    remember(end.products, end.by_cells);
}

template <int dim>
void Evolution<dim>::remember(const body::FieldProducts &products, bool by_cells) {
  remembered_ = {std::vector<double>(state_.size(), 0.), by_cells};
  body::add_history<dim>(products, remembered_.heats);
}

template <int dim>
typename Evolution<dim>::Point Evolution<dim>::point() const {
  Point point{state_, remembered_, {}, route_->memory()};
  leaked_.save(point.rest);
  if (electrodes_)
    electrodes_->save(point.rest);
  foundations_.save(point.rest);
  motion_.save(point.rest);
  return point;
}

template <int dim>
void Evolution<dim>::go_back(const Point &point, int n) {
  state_ = point.state;
  remembered_ = point.remembered;
  last_ = 0;
  leaked_.restore(point.rest);
  if (electrodes_)
    electrodes_->restore(point.rest);
  foundations_.restore(point.rest);
  motion_.restore(point.rest);
  route_->begin_step(n, point.route);
}

template <int dim>
void Evolution<dim>::save(output::SavedNumbers &numbers) const {
  numbers.put_field("state", state_);
  leaked_.save(numbers);
  if (electrodes_)
    electrodes_->save(numbers);
  foundations_.save(numbers);
  motion_.save(numbers);
  route_->save(numbers);
}

template <int dim>
void Evolution<dim>::restore(const output::SavedNumbers &numbers) {
  numbers.fill("state", state_);
  leaked_.restore(numbers);
  if (electrodes_)
    electrodes_->restore(numbers);
  foundations_.restore(numbers);
  motion_.restore(numbers);
  route_->restore(numbers);
}

template class Evolution<2>;
template class Evolution<3>;

}  // namespace tourmaline::run
