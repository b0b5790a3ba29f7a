#include "run/chosen_route.h"

#include <fmt/format.h>

#include <algorithm>

#include "case/electrodes.h"
#include "parallel/available_memory.h"
#include "parallel/ranks.h"
#include "run/memory.h"
#include "solve/condensed_route.h"
#include "solve/iterative_route.h"
#include "solve/monolithic_route.h"

namespace tourmaline::run {

namespace {

constexpr double gibibyte = 1 << 30;

template <int dim>
std::unique_ptr<solve::Route> make_route(const solve::Model<dim> &model, bool iterative) {
  if (model.asked.solver.method == "monolithic")
    return solve::monolithic_route(model);
  if (iterative)
    return solve::iterative_route(model);
  return solve::condensed_route(model);
}

}  // namespace

template <int dim>
ChosenRoute<dim>::ChosenRoute(solve::Model<dim> &model, bool iterative, output::Progress &progress,
                              int first)
    : model_(model), progress_(progress), iterative_(iterative) {
  model_.set_step(model_.steps.size(first));
  progress_.stage(iterative_ ? "preconditioner" : "factorisation");
  route_ = made_route();
}

// What takes long within its steps stands in the progress line.
template <int dim>
std::unique_ptr<solve::Route> ChosenRoute<dim>::made_route() {
  std::unique_ptr<solve::Route> route = make_route(model_, iterative_);
  route->tell([&progress = progress_](const char *what, int done, int all) {
    progress.part(what, done, all);
  });
  return route;
}

template <int dim>
std::unique_ptr<solve::Route> ChosenRoute<dim>::kept_of(double step) {
  const auto found = std::find_if(kept_.begin(), kept_.end(),
                                  [step](const Kept &one) { return one.step == step; });
  if (found == kept_.end())
    return nullptr;
  std::unique_ptr<solve::Route> route = std::move(found->route);
  kept_.erase(found);
  return route;
}

// Until a further factorisation fits.
template <int dim>
void ChosenRoute<dim>::make_room() {
  const auto has_room = [&] {
    const bool fits = another_factorisation(model_.asked) <= parallel::available_memory().bytes;
    return parallel::from_first(fits) != 0;
  };
  while (!kept_.empty() && !has_room())
    kept_.erase(kept_.begin());
}

// Only a factorised body is worth keeping: other routes factorise, or make a preconditioner, while
// they take a step.
template <int dim>
void ChosenRoute<dim>::take_size(double step) {
  const double before = model_.step;
  if (step == before)
    return;
  if (is_factorised())
    kept_.push_back({before, std::move(route_)});
  route_ = kept_of(step);
  model_.set_step(step);
  if (route_)
    return;
  make_room();
  progress_.stage(iterative_ ? "preconditioner" : "factorisation");
  try {
    route_ = made_route();
  } catch (const MachineError &) {  // the estimate is one
    if (kept_.empty())
      throw;
    kept_.clear();
    route_ = made_route();
  }
}

template <int dim>
void ChosenRoute<dim>::begin_step(int n) {
  const double step = model_.steps.size(n);
  if (step == model_.step)
    return;
  const solve::Route::Handover done = route_->hand_over();
  take_size(step);
  route_->take_over(done);
}

template <int dim>
typename ChosenRoute<dim>::Memory ChosenRoute<dim>::memory() const {
  return {iterative_, route_->accumulated_slip(), route_->memory()};
}

// What an iterative route remembers serves no other one, but for the slip.
template <int dim>
void ChosenRoute<dim>::begin_step(int n, const Memory &from) {
  const double step = model_.steps.size(n);
  if (from.iterative == iterative_) {
    const solve::Route::Handover done{route_->hand_over().report, from.of_route};
    take_size(step);
    route_->take_over(done);
    return;
  }
  take_size(step);
  if (from.accumulated_slip.size() > 0)
    route_->go_on_from(from.accumulated_slip);
}

template <int dim>
solve::RouteReport ChosenRoute<dim>::report(int sizes) const {
  solve::RouteReport report = route_->report();
  if (is_factorised())
    report.factorisations = sizes;
  return report;
}

template <int dim>
solve::StepOutcome ChosenRoute<dim>::advance(int n, std::span<const double> right_side,
                                             std::span<const double> state,
                                             std::span<double> next) {
  if (!iterative_ || model_.asked.solver.body != "automatic")
    return route_->advance(model_.time(n), right_side, state, next);
  const std::vector<double> start(next.begin(), next.end());
  try {
    return route_->advance(model_.time(n), right_side, state, next);
  } catch (const SolveError &error) {
    factorise_after_all(n, error);
  }
  std::copy(start.begin(), start.end(), next.begin());
  return route_->advance(model_.time(n), right_side, state, next);
}

// "automatic" took the iterative solution to save memory. Where that fails, a factorisation is
// worth all the memory that there is.
template <int dim>
void ChosenRoute<dim>::factorise_after_all(int n, const SolveError &error) {
  if (!model_.sharing().is_whole())
    throw SolveError(fmt::format(
        "{}. There was no memory for a factorisation when the run began, and the nodes of the body "
        "have been shared out to the ranks since; take solver.body = \"direct\"",
        error.what()));
  // With what the iterative route gives back; until then that may have to take shorter steps.
  const double needed = factorised_memory(model_.asked),
               available = parallel::available_memory().bytes + iterative_memory(model_.asked);
  if (parallel::from_first(needed > available) != 0)
    throw SolveError(
        fmt::format("{}. A factorisation needs about {:.3g} GiB of memory, and {:.3g} "
                    "GiB are available",
                    error.what(), needed / gibibyte, available / gibibyte));
  const Eigen::VectorXd slip = route_->accumulated_slip();
  route_.reset();
  iterative_ = false;
  direct_from_ = n;
  progress_.stage("factorisation");
  route_ = made_route();
  if (slip.size() > 0)
    route_->go_on_from(slip);
}

template <int dim>
std::vector<std::string> ChosenRoute<dim>::warnings() const {
  if (direct_from_ > 0)
    return {fmt::format(
        "solver.body = \"automatic\": the iterative solution of the body's equations, taken to "
        "save memory, failed in step {}; from there on they were factorised",
        direct_from_)};
  if (iterative_ && model_.asked.solver.body == "automatic")
    return {fmt::format(
        "solver.body = \"automatic\": the body's equations were solved iteratively, because a "
        "factorisation needs about {:.3g} GiB, more than half of what is available",
        factorised_memory(model_.asked) / gibibyte)};
  return {};
}

template <int dim>
void ChosenRoute<dim>::save(output::SavedNumbers &numbers) const {
  numbers.put("iterative", {double(iterative_)});
  numbers.put("direct from", {double(direct_from_)});
  numbers.put("size of the step", {model_.step});
  route_->save(numbers);
}

template <int dim>
void ChosenRoute<dim>::restore(const output::SavedNumbers &numbers) {
  direct_from_ = static_cast<int>(numbers.get("direct from", 1)[0]);
  route_->restore(numbers, numbers.get("size of the step", 1)[0] != model_.step);
}

template <int dim>
bool ChosenRoute<dim>::was_iterative(const output::SavedNumbers &numbers) {
  return numbers.get("iterative", 1)[0] != 0;
}

template class ChosenRoute<2>;
template class ChosenRoute<3>;

}  // namespace tourmaline::run
