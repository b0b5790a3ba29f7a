#include "run/adrift.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "output/place.h"
#include "solve/leaning.h"
#include "tourmaline/error.h"

namespace tourmaline::run {

template <int dim>
Adrift<dim>::Adrift(const solve::Model<dim> &model)
    : model_(model), left_to_contact_(solve::resisted_by_contact_alone(model)) {}

// Friction that slips holds, too: whether it lets go is for the balance of forces to say.
template <int dim>
std::vector<casefile::Support> Adrift<dim>::supports(const solve::StepOutcome &outcome) const {
  const auto rubs = [&](std::size_t node) {
    const auto first = dim * static_cast<Eigen::Index>(node);
    return outcome.status[node] == ContactStatus::stick ||
           !outcome.friction_forces.segment<dim>(first).isZero(0);
  };
  return solve::supports_of(model_, outcome.status, rubs);
}

// Round-off of a stiffness that has nothing there may hold the body against any load, and whether
// it does differs from one way of summing to the next: loads are asked, not displacements.
template <int dim>
bool Adrift<dim>::works_on(const casefile::RigidMotion &motion,
                           std::span<const double> loads) const {
  constexpr double counts = 1e-5;  // of all that works: loads may balance to few digits
  std::array<double, 2> work{};    // and the sum of its sizes
  for (body::Node node = 0; node < model_.body.n_nodes(); ++node) {
    if (!model_.sharing().counts(node))
      continue;
    const Vector3 moved = motion.at(model_.body.points()[node]);
    for (int c = 0; c < dim; ++c) {
      const double of_one = loads[body::unknown<dim>(node, c)] * moved[c];
      work[0] += of_one;
      work[1] += std::abs(of_one);
    }
  }
  model_.sharing().sum(work);
  return std::abs(work[0]) > counts * work[1];
}

template <int dim>
bool Adrift<dim>::is_carried_off(const std::vector<casefile::Support> &held,
                                 std::span<const double> loads) const {
  const auto &[low, high] = model_.body.bounds();
  const Vector3 middle{(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, (low[2] + high[2]) / 2};
  const auto free = casefile::free_modes(model_.asked, held, middle,
                                         output::largest_extent(model_.body.bounds()));
  return std::any_of(free.begin(), free.end(),
                     [&](const casefile::RigidMotion &motion) { return works_on(motion, loads); });
}

template <int dim>
void Adrift<dim>::require_near(int n, std::span<const double> state) const {
  constexpr double farthest = 1e3;  // displacements that are small are a hundredth of the body
  double square = 0;
  for (body::Node node = 0; node < model_.body.n_nodes(); ++node) {
    double of_node = 0;
    for (int c = 0; c < dim; ++c)
      of_node += std::pow(state[body::unknown<dim>(node, c)], 2);
    square = std::max(square, of_node);
  }
  const double displacement = std::sqrt(model_.sharing().largest(square));
  if (displacement <= farthest * output::largest_extent(model_.body.bounds()))
    return;
  throw SolveError(fmt::format(
      "step {}: the body has left by {:.2g} m; nothing but contact keeps it from {}, and the "
      "contact did not. Prescribe further components of `displacement`{}, or press the body to the "
      "foundation from the start, without a gap",
      n, displacement, left_to_contact_,
      model_.asked.solver.method == "condensed"
          ? ""
          : ", take solver.method = \"condensed\", which finds the contact that holds it"));
}

template <int dim>
void Adrift<dim>::step(int n, const solve::StepOutcome &outcome, std::span<const double> loads,
                       std::span<const double> state) {
  if (left_to_contact_.empty())
    return;
  const std::vector<casefile::Support> held = supports(outcome);
  const std::string free = casefile::free_motions_in_words(model_.asked, held);
  if (!free.empty() && is_carried_off(held, loads))
    solve::let_go(model_.time(n), free);
  require_near(n, state);
  if (!free.empty() && ++steps_ == 1)
    first_ = n;
}

template <int dim>
std::string Adrift<dim>::warning() const {
  if (steps_ == 0)
    return "";
  return fmt::format(
      "nothing held the body in {}: its contact had let go, and no load worked on all that only "
      "contact keeps it from, {}. Where it stands along such a motion is arbitrary there; "
      "deformation, forces and the other fields are not. Prescribe further components of "
      "`displacement`, or press the body to the foundation",
      steps_ == 1 ? fmt::format("step {}", first_)
                  : fmt::format("{} steps, first in step {}", steps_, first_),
      left_to_contact_);
}

template <int dim>
void Adrift<dim>::save(output::SavedNumbers &numbers) const {
  numbers.put("adrift", {double(steps_), double(first_)});
}

template <int dim>
void Adrift<dim>::restore(const output::SavedNumbers &numbers) {
  const auto saved = numbers.get("adrift", 2);
  steps_ = static_cast<int>(saved[0]);
  first_ = static_cast<int>(saved[1]);
}

template class Adrift<2>;
template class Adrift<3>;

}  // namespace tourmaline::run
