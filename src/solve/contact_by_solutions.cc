#include "solve/contact_by_solutions.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "solve/leaning.h"
#include "solve/natural_map.h"

namespace tourmaline::solve {

namespace {

using Eigen::Index;
using Eigen::VectorXd;

// What a Newton iteration has gained so far.
class Progress {
 public:
  // `lack`: of the body, where the contact is solved.
  void see(int iteration, double contact_residual, std::optional<double> lack) {
    if (contact_residual < least_ || (lack && *lack < least_lack_))
      last_gain_ = iteration;
    least_ = std::min(least_, contact_residual);
    least_lack_ = std::min(least_lack_, lack.value_or(least_lack_));
  }
  int last_gain() const { return last_gain_; }

 private:
  double least_ = std::numeric_limits<double>::infinity(), least_lack_ = least_;
  int last_gain_ = 0;
};

}  // namespace

template <int dim>
ContactBySolutions<dim>::ContactBySolutions(const Model<dim> &model,
                                            const std::vector<bool> &is_prescribed,
                                            BodyEquations<dim> &body, RouteReport &count,
                                            bool is_leaning, double tolerance)
    : model_(model),
      body_(body),
      count_(count),
      is_leaning_(is_leaning),
      tolerance_(tolerance),
      contact_(model, is_prescribed),
      exchange_(model),
      seen_(model, is_prescribed, body, contact_, is_leaning) {
  count_.safe_steps = 0;
}

template <int dim>
void ContactBySolutions<dim>::begin_step(double time, std::span<const double> before,
                                         std::span<double> state) {
  time_ = time;
  state_ = state;
  contact_.begin_step(time, before, state);
  exchange_.begin_step(time, state);
  seen_.begin_step(time, state, tolerance_);
}

template <int dim>
std::string ContactBySolutions<dim>::unheld() const {
  return unheld_motions(model_, contact_, solution_.interface.status);
}

// False where friction is too stiff for the linear iteration.
template <int dim>
bool ContactBySolutions<dim>::newton_step(const ContactTangent &tangent,
                                          std::vector<double> residual) {
  constexpr double reduction = 1e-2;  // what is left, the next iteration takes
  // Linear iterations; refined, each solve takes its residual down further by powers of ten.
  const std::size_t tiresome = body_.is_refined() ? 300 : 100;
  const std::size_t before = count_.krylov_iterations;
  return seen_.newton_step(tangent, std::move(residual), reduction) &&
         (is_without_points() || count_.krylov_iterations - before <= tiresome);
}

// Newton's method on all unknowns at once, in which body and contact settle together. It may cycle;
// false when it has gained nothing in a while.
template <int dim>
bool ContactBySolutions<dim>::find_fast() {
  constexpr int patience = 10;
  const int most = std::min(30, model_.asked.solver.max_iterations);
  const NaturalMap map(coupled(), 1);
  Progress progress;
  for (int k = 0; k <= most && k - progress.last_gain() < patience; ++k) {
    const NaturalMap::Place x = seen_.look();
    const ContactTangent tangent = map.tangent(x);
    std::vector<double> residual = freed(body_.residual());
    const double worst = map.residual(x);
    const bool contact_is_solved = worst <= tolerance_;
    if (k > 0 && contact_is_solved && body_.is_solved(residual)) {
      if (tangent.known.isZero(0)) {
        solution_ = map.solution(x);
        return true;
      }
      seen_.put(x.d + tangent.known);  // held points exactly where they are held
      continue;
    }
    // Before the first solve a contact without forces is solved by itself, and no later one is more
    // so. Where only the contact holds the body, which Newton's method may carry off, that counts.
    if (k > 0 || is_leaning_)
      progress.see(k, worst, contact_is_solved ? std::optional(body_.lack()) : std::nullopt);
    if (!newton_step(tangent, std::move(residual)))
      return false;
  }
  return false;
}

template <int dim>
CoupledSolution ContactBySolutions<dim>::solve_from(const VectorXd &start) {
  seen_.begin_anew();
  const InterfaceSettings settings{tolerance_, model_.asked.solver.max_iterations, !is_leaning_};
  return solve_coupled(coupled(), start, settings);
}

// Where only the contact holds the body, a linear system on the way may have no solution. Weak
// springs between contact and foundation lead to where the contact holds.
template <int dim>
void ContactBySolutions<dim>::find_safely(const VectorXd &start) {
  count_.safe_steps += !is_without_points();  // without them there is only the body to go on with
  solution_ = solve_from(start);
  VectorXd sprung = start;
  for (const double weak : {1e-2, 1e-4, 1e-6}) {
    if (solution_.interface.converged || !is_leaning_)
      break;
    seen_.set_springs(weak);
    sprung = solve_from(sprung).interface.increment;
    seen_.set_springs(0);
    solution_ = solve_from(sprung);
  }
}

// What crosses the contact by its state is held, the step solved, and so on.
template <int dim>
bool ContactBySolutions<dim>::settle() {
  seen_.forget_iterations();
  do {
    body_.hold(exchange_);
    if (!settle_contact())
      return false;
  } while (!exchange_.is_empty() && !exchange_.settle(time_, state_, states(), tolerance_));
  if (!exchange_.is_empty())
    solution_.stage = ContactStage::fixed_point;
  return true;
}

// Where the displacements are the small difference of larger ones, once more with points that slip
// or are open measured from where they were.
template <int dim>
bool ContactBySolutions<dim>::settle_contact() {
  if (!find())
    return false;
  if (!contact_.loses_digits(solution_))
    return true;
  const ContactStage stage = solution_.stage;
  contact_.measure_from_before(solution_);
  seen_.put(solution_.interface.increment);
  if (!find())
    return false;
  contact_.measure_from_stuck(solution_);
  seen_.take(solution_.interface.increment);
  solution_.stage = stage;
  return true;
}

// Both stages begin with the state that is predicted.
template <int dim>
bool ContactBySolutions<dim>::find() {
  const VectorXd start = seen_.unknowns();
  const std::vector<double> state(state_.begin(), state_.end());
  is_found_safely_ = !find_fast();
  if (is_found_safely_) {
    std::copy(state.begin(), state.end(), state_.begin());
    find_safely(start);
    if (!solution_.interface.converged)
      return false;
  }
  if (!contact_.is_coupled())
    solution_.stage = ContactStage::convex;
  return true;
}

// Of contact and body at once; refined, the last correction was so, unless the safe stage has made
// it, of the body alone. Points that carry a share of their law are not what Newton's method
// on all unknowns sees in them: then of the body alone.
template <int dim>
double ContactBySolutions<dim>::forward_error() {
  if (body_.is_refined() && !is_found_safely_)
    return body_.last_correction();
  const NaturalMap map(coupled(), 1);
  std::vector<double> residual = body_.residual_by_cells();
  if (map.residual(seen_.place(body_.residual())) <= tolerance_) {
    const ContactTangent tangent = map.tangent(seen_.place(residual));
    return seen_.forward_error(tangent, std::move(residual));
  }
  body_.system().set_contact(seen_.held());
  return body_.forward_error(freed(std::move(residual)));
}

template <int dim>
StepOutcome ContactBySolutions<dim>::outcome() {
  const auto n = static_cast<Index>(model_.interface.size());
  StepOutcome outcome;
  outcome.contact_forces = -seen_.at_contact(body_.residual());
  outcome.friction_forces = VectorXd::Zero(dim * n);
  outcome.status.resize(model_.interface.size());
  if (contact_.is_coupled())
    outcome.friction_bound = VectorXd::Zero(n);
  if (model_.laws.remembers_slip())
    outcome.accumulated_slip = VectorXd::Zero(n);
  solution_.interface.iterations = iterations();
  contact_.end_step(solution_, outcome);
  exchange_.end_step(state_, states(), outcome);
  return outcome;
}

template <int dim>
void ContactBySolutions<dim>::take_back() {
  contact_.take_back();
  exchange_.take_back();
}

template <int dim>
void ContactBySolutions<dim>::save(output::SavedNumbers &numbers) const {
  contact_.save(numbers);
  exchange_.save(numbers);
}

template <int dim>
void ContactBySolutions<dim>::restore(const output::SavedNumbers &numbers) {
  contact_.restore(numbers);
  exchange_.restore(numbers);
}

template class ContactBySolutions<2>;
template class ContactBySolutions<3>;

}  // namespace tourmaline::solve
