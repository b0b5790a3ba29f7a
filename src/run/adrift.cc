#include "run/adrift.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "larger.h"
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
void Adrift<dim>::require_held(double time, const std::vector<casefile::Support> &held,
                               std::span<const double> loads) const {
  using solve::RigidWork;
  RigidWork work(solve::free_modes_of(model_, held));
  work.add_loads(model_, loads);
  if (!(work.imbalance(RigidWork::summed) <= RigidWork::unbalanced))
    solve::let_go(time, casefile::free_motions_in_words(model_.asked, held));
}

// What holds one direction does not hide what another lacks.
template <int dim>
void Adrift<dim>::require_balanced(int n, const solve::StepOutcome &outcome,
                                   std::span<const double> loads, double displacement) const {
  using solve::RigidWork;
  constexpr double far = 10;
  RigidWork work = RigidWork::left_to_contact(model_);
  work.add_loads(model_, loads);
  work.add_at_contact(model_, outcome.contact_forces);
  const bool is_far =
      displacement > far * solve::held_motion(model_, model_.time(n), outcome.status);
  const double tolerance = RigidWork::allowed(model_.asked.solver, is_far);
  if (work.imbalance(RigidWork::uncertain) <= tolerance)
    return;
  const double lacks = work.imbalance(
      RigidWork::uncertain, solve::round_off_where_held(model_, model_.time(n), outcome.status));
  if (lacks <= tolerance)
    return;
  throw SolveError(fmt::format(
      "step {}, t = {:g} s: loads and contact forces differ by {:.1e} of their size along what "
      "nothing but contact keeps the body from, {}: under these loads the body slides or leaves, "
      "or no equilibrium was found that holds it. Nothing of this step was written. Prescribe "
      "further components of `displacement`, press the body to the foundation, let inertia or "
      "damping resist (time.regime = \"dynamic\"){}",
      n, model_.time(n), lacks, left_to_contact_,
      model_.asked.solver.method == "condensed" ? "" : ", or take solver.method = \"condensed\""));
}

template <int dim>
double Adrift<dim>::largest_displacement(std::span<const double> state) const {
  double square = 0;
  for (body::Node node = 0; node < model_.body.n_nodes(); ++node) {
    double of_node = 0;
    for (int c = 0; c < dim; ++c)
      of_node += std::pow(state[body::unknown<dim>(node, c)], 2);
    square = larger(square, of_node);
  }
  return std::sqrt(model_.sharing().largest(square));
}

template <int dim>
void Adrift<dim>::require_near(int n, const solve::StepOutcome &outcome, bool is_held,
                               double displacement) const {
  const double farthest = is_held ? 1e3 : 1e5;  // where it is not held it may stand anywhere
  if (displacement <= farthest * solve::held_motion(model_, model_.time(n), outcome.status))
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
  const bool is_held = casefile::free_motions(model_.asked, held).empty();
  if (!is_held)
    require_held(model_.time(n), held, loads);
  const double displacement = largest_displacement(state);
  require_near(n, outcome, is_held, displacement);
  require_balanced(n, outcome, loads, displacement);
  if (!is_held && ++steps_ == 1)
    first_ = n;
}

template <int dim>
std::string Adrift<dim>::warning() const {
  if (steps_ == 0)
    return "";
  return fmt::format(
      "nothing held the body in {}: its contact had let go, and no load worked on what was free of "
      "that which only contact keeps it from, {}. Where it stands along such a motion is arbitrary "
      "there; "
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
