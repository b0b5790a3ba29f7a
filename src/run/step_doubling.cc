#include "run/step_doubling.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "body/backward_error.h"
#include "body/fields.h"
#include "case/tables_in_time.h"
#include "larger.h"
#include "tourmaline/error.h"

namespace tourmaline::run {

namespace {

double longest(const casefile::TimeCase &time) {
  return time.end / time.steps;
}

std::vector<double> since(const std::vector<double> &state, const std::vector<double> &before) {
  std::vector<double> change(state.size());
  std::transform(state.begin(), state.end(), before.begin(), change.begin(), std::minus<>());
  return change;
}

// Forces and places that agree to these digits are the same.
constexpr double same = 1e-8;

}  // namespace

template <int dim>
StepDoubling<dim>::StepDoubling(solve::Model<dim> &model, Evolution<dim> &evolution)
    : model_(model),
      evolution_(evolution),
      ladder_(model.asked.time.end, longest(model.asked.time), casefile::bends(model.asked)),
      initial_(evolution.state()),
      scale_(model.op.scales(longest(model.asked.time))) {
  model_.steps.keep(0);
}

template <int dim>
void StepDoubling<dim>::plan(const output::SavedNumbers *numbers) {
  if (numbers)
    restore(*numbers);
  if (is_at_end())
    return;
  const StepLadder::Pair pair = ladder_.pair();
  model_.steps.append(2 * pair.size, pair.end);
}

template <int dim>
TakenStep StepDoubling<dim>::take(int n, double size, double end, const Point *from) {
  model_.steps.keep(n - 1);
  model_.steps.append(size, end);
  sizes_.insert(size);
  ++computed_;
  if (from)
    evolution_.go_back(*from, n);
  return evolution_.take(n);
}

template <int dim>
std::array<TakenStep, 2> StepDoubling<dim>::next(int n) {
  const Point start = evolution_.point();
  std::optional<TakenStep> whole;
  double spent = 0;  // on what does not count [s]
  for (;;) {
    const StepLadder::Pair pair = ladder_.pair();
    std::array<TakenStep, 2> halves;
    double wrong = std::numeric_limits<double>::infinity();
    try {
      if (!whole)
        spent += whole.emplace(take(n + 1, 2 * pair.size, pair.end, &start)).seconds;
      halves[0] = take(n + 1, pair.size, pair.middle, &start);
      halves[1] = take(n + 2, pair.size, pair.end, nullptr);
      wrong = error(*whole, halves[1], 2 * pair.size);
    } catch (const SolveError &) {
      if (!ladder_.can_shrink())
        throw;
    }
    if (wrong <= 1 || !ladder_.can_shrink()) {
      see_rough(wrong, n);
      ladder_.accept(wrong);
      halves[0].seconds += spent;
      return halves;
    }
    ++rejected_;
    ladder_.reject(wrong);
    // The first of the two is the whole of the next pair, if that is half as long.
    spent += halves[0].seconds + halves[1].seconds;
    whole.reset();
    if (halves[0].n > 0 && ladder_.pair().end == pair.middle)
      whole.emplace(std::move(halves[0]));
  }
}

template <int dim>
void StepDoubling<dim>::see_rough(double error, int n) {
  if (error > 1 && ++rough_ == 1)
    first_rough_ = model_.time(n);
}

template <int dim>
double StepDoubling<dim>::error(const TakenStep &whole, const TakenStep &halves, double length) {
  const casefile::TimeCase &time = model_.asked.time;
  const double of_fields = field_error(whole, halves) / *time.tolerance;
  const double of_times = length / (*time.tolerance * time.end);
  if (of_times > 1 && status_differs(whole, halves))
    return std::max(of_fields, 2.);
  return of_fields;
}

template <int dim>
double StepDoubling<dim>::field_error(const TakenStep &whole, const TakenStep &halves) {
  const body::NodeSharing &sharing = model_.sharing();
  for (const TakenStep *step : {&whole, &halves}) {
    const body::FieldSizes changes =
        body::field_sizes<dim>(sharing, since(step->state, initial_), scale_);
    for (std::size_t field = 0; field < changes.size(); ++field)
      changes_[field] = larger(changes_[field], changes[field]);
  }
  return body::relative_size(
      body::field_sizes<dim>(sharing, since(whole.state, halves.state), scale_), changes_);
}

// Statuses between which nothing lies, as of a point that is closed without pressure, are one.
template <int dim>
bool StepDoubling<dim>::status_differs(const TakenStep &whole, const TakenStep &halves) const {
  const Eigen::VectorXd &forces = halves.outcome.contact_forces;
  const double force = same * forces.template lpNorm<Eigen::Infinity>();
  const double change = same * changes_[0];
  for (std::size_t i = 0; i < model_.interface.size(); ++i) {
    if (whole.outcome.status[i] == halves.outcome.status[i])
      continue;
    for (int c = 0; c < dim; ++c) {
      const auto row = dim * static_cast<Eigen::Index>(i) + c;
      const std::size_t u = body::unknown<dim>(model_.interface[i].node, c);
      if (std::abs(whole.outcome.contact_forces[row] - forces[row]) > force ||
          std::abs(whole.state[u] - halves.state[u]) > change * scale_[c])
        return true;
    }
  }
  return false;
}

template <int dim>
std::string StepDoubling<dim>::warning() const {
  if (rough_ == 0)
    return "";
  return fmt::format(
      "time.tolerance = {:g} was not reached in {} of steps, first behind t = {:g} s: what "
      "happens there has no size of steps with which its error falls, as a jump has",
      *model_.asked.time.tolerance, rough_ == 1 ? "one pair" : fmt::format("{} pairs", rough_),
      first_rough_);
}

template <int dim>
void StepDoubling<dim>::save(output::SavedNumbers &numbers) const {
  std::vector<double> ends, sizes;
  for (int n = 1; n <= model_.steps.count(); ++n) {
    ends.push_back(model_.steps.at(n));
    sizes.push_back(model_.steps.size(n));
  }
  numbers.put("steps", {static_cast<double>(ends.size())});
  numbers.put("ends of steps", ends);
  numbers.put("sizes of steps", sizes);
  numbers.put("number of sizes", {static_cast<double>(sizes_.size())});
  numbers.put("tried sizes", std::vector<double>(sizes_.begin(), sizes_.end()));
  numbers.put("largest changes", changes_);
  numbers.put_field("initial state", initial_);
  numbers.put("step doubling",
              {double(rejected_), double(computed_), double(rough_), first_rough_});
  ladder_.save(numbers);
}

template <int dim>
void StepDoubling<dim>::restore(const output::SavedNumbers &numbers) {
  const auto n_steps = static_cast<std::size_t>(numbers.get("steps", 1)[0]);
  const auto ends = numbers.get("ends of steps", n_steps),
             sizes = numbers.get("sizes of steps", n_steps);
  for (std::size_t i = 0; i < n_steps; ++i)
    model_.steps.append(sizes[i], ends[i]);
  const auto n_sizes = static_cast<std::size_t>(numbers.get("number of sizes", 1)[0]);
  const auto tried = numbers.get("tried sizes", n_sizes);
  sizes_.insert(tried.begin(), tried.end());
  numbers.fill("largest changes", changes_);
  numbers.fill("initial state", initial_);
  const auto counts = numbers.get("step doubling", 4);
  rejected_ = static_cast<int>(counts[0]);
  computed_ = static_cast<int>(counts[1]);
  rough_ = static_cast<int>(counts[2]);
  first_rough_ = counts[3];
  ladder_.restore(numbers);
}

template class StepDoubling<2>;
template class StepDoubling<3>;

}  // namespace tourmaline::run
