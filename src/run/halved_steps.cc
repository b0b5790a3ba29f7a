#include "run/halved_steps.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "stopwatch.h"
#include "tourmaline/error.h"

namespace tourmaline::run {

namespace {

template <int dim>
bool depends_on_state(const solve::Model<dim> &model) {
  return model.laws.friction_depends_on_pressure() ||
         model.laws.crosses_by_state(contact::Crossing::heat) ||
         model.laws.crosses_by_state(contact::Crossing::charge);
}

double shortest(const casefile::TimeSteps &steps) {
  constexpr double parts = 16;  // of the shortest step that was asked for
  double size = std::numeric_limits<double>::infinity();
  for (int n = 1; n <= steps.count(); ++n)
    size = std::min(size, steps.size(n));
  return size / parts;
}

}  // namespace

template <int dim>
HalvedSteps<dim>::HalvedSteps(solve::Model<dim> &model, Evolution<dim> &evolution,
                              const output::SavedNumbers *numbers)
    : model_(model),
      evolution_(evolution),
      may_be_unsettled_(depends_on_state(model)),
      shortest_(shortest(model.steps)) {
  if (!numbers)
    return;
  const auto counts = numbers->get("halved steps", 2);
  const auto halved = numbers->get("numbers of halved steps", static_cast<std::size_t>(counts[0]));
  halved_.assign(halved.begin(), halved.end());
  first_ = counts[1];
  for (const double n : halved_)
    model_.steps.halve(static_cast<int>(n));
}

template <int dim>
TakenStep HalvedSteps<dim>::take(int n) {
  if (!may_be_unsettled_)
    return evolution_.take(n);
  const typename Evolution<dim>::Point start = evolution_.point();
  double spent = 0;  // on what does not count [s]
  for (Stopwatch watch;;) {
    try {
      TakenStep step = evolution_.take(n);
      step.seconds += spent;
      return step;
    } catch (const UnsettledStep &error) {
      if (model_.steps.size(n) / 2 < shortest_)
        throw UnsettledStep(fmt::format("{}; steps of down to {:.3g} s were tried", error.what(),
                                        model_.steps.size(n)));
    }
    spent += watch.lap();
    if (halved_.empty())
      first_ = model_.time(n - 1);
    halved_.push_back(n);
    model_.steps.halve(n);
    evolution_.go_back(start, n);
  }
}

template <int dim>
std::string HalvedSteps<dim>::warning() const {
  if (halved_.empty())
    return "";
  const std::size_t n = halved_.size();
  return fmt::format(
      "the contact of {} was not found, and two steps of half the size were taken in the place of "
      "each, first behind t = {:g} s: there {} than the case asks for",
      n == 1 ? "one step" : fmt::format("{} steps", n), first_,
      n == 1 ? "is one step more" : fmt::format("are {} steps more", n));
}

template <int dim>
void HalvedSteps<dim>::save(output::SavedNumbers &numbers) const {
  numbers.put("halved steps", {static_cast<double>(halved_.size()), first_});
  numbers.put("numbers of halved steps", halved_);
}

template class HalvedSteps<2>;
template class HalvedSteps<3>;

}  // namespace tourmaline::run
