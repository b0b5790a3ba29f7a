#include "solve/contact_by_solutions.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "larger.h"
#include "parallel/ranks.h"
#include "solve/leaning.h"
#include "solve/leaning_programme.h"
#include "solve/natural_map.h"
#include "solve/rigid_work.h"

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
                                            bool is_leaning, double tolerance, Route::Listener say)
    : model_(model),
      body_(body),
      count_(count),
      is_leaning_(is_leaning),
      tolerance_(tolerance),
      say_(std::move(say)),
      contact_(model, is_prescribed),
      exchange_(model),
      seen_(model, is_prescribed, body, contact_, is_leaning) {}

template <int dim>
void ContactBySolutions<dim>::begin_step(double time, std::span<const double> before,
                                         std::span<double> state) {
  time_ = time;
  state_ = state;
  needed_safe_stage_ = false;
  contact_.begin_step(time, before, state);
  exchange_.begin_step(time, state);
  seen_.begin_step(time, state, tolerance_);
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
  body_.begin_corrections();
  for (int k = 0; k <= most; ++k) {
    const NaturalMap::Place x = seen_.look();
    const ContactTangent tangent = map.tangent(x);
    std::vector<double> residual = freed(body_.residual());
    const double worst = map.residual(x);
    const bool contact_is_solved = worst <= tolerance_;
    if (k > 0 && contact_is_solved && body_.is_solved(residual)) {
      if (tangent.known.isZero(0)) {
        solution_ = map.solution(x);
        solution_.interface.converged = true;
        return true;
      }
      seen_.put(x.d + tangent.known);  // held points exactly where they are held
      continue;
    }
    // Before the first solve a contact without forces is solved by itself, and no later one is more
    // so. Where only the contact holds the body, which Newton's method may carry off, that counts.
    if (k > 0 || is_leaning_)
      progress.see(k, worst, contact_is_solved ? std::optional(body_.lack()) : std::nullopt);
    if (k == most || k - progress.last_gain() >= patience ||
        !newton_step(tangent, std::move(residual)))
      return false;
  }
  return false;
}

template <int dim>
CoupledSolution ContactBySolutions<dim>::solve_from(const VectorXd &start, int in_all) {
  seen_.begin_anew();
  InterfaceSettings settings{tolerance_, model_.asked.solver.max_iterations, !is_leaning_};
  settings.in_all = in_all;
  return solve_coupled(coupled(), start, settings);
}

// Where only the contact holds the body, a linear system on the way may have no solution. Weak
// springs between contact and foundation lead to where the contact holds.
template <int dim>
void ContactBySolutions<dim>::find_by_solutions(const VectorXd &start) {
  solution_ = solve_from(start);
  VectorXd sprung = start;
  for (const double weak : {1e-2, 1e-4, 1e-6}) {
    if (!is_leaning_ || !is_lost())
      break;
    seen_.set_springs(weak);
    sprung = solve_from(sprung).interface.increment;
    seen_.set_springs(0);
    solution_ = solve_from(sprung);
  }
}

// That of an earlier step may be of another step size or of other slopes of what crosses. False
// where another way may lead further.
template <int dim>
bool ContactBySolutions<dim>::find_by_matrix(const VectorXd &start, const Begin &begin) {
  if (matrix_) {
    begin();
    settle_by_matrix(start);
    if (!is_lost())
      return true;
  }
  begin();
  solution_.interface.converged = false;
  matrix_ = made_matrix();
  has_no_matrix_ = !matrix_;
  return matrix_ && settle_by_matrix(start);
}

template <int dim>
std::optional<Eigen::MatrixXd> ContactBySolutions<dim>::made_matrix() {
  const auto all = static_cast<int>(contact_.n_unknowns());
  say_("matrix of the contact", 0, all);
  return seen_.matrix([&](Index done) {
    ++count_.contact_columns;
    say_("matrix of the contact", static_cast<int>(done), all);
  });
}

// As that of a condensed body. What A's error leaves is seen in the forces where its solution
// leads, and the next one takes it into account, until that gains little; the best of them stays.
// False where that was not enough. What the matrix tells of a body that nothing but its contact
// holds is final.
template <int dim>
bool ContactBySolutions<dim>::settle_by_matrix(const VectorXd &start) {
  VectorXd d = start, force = seen_.force(d);
  double before = std::numeric_limits<double>::infinity(), error = before;
  std::optional<CoupledSolution> best;
  do {
    before = error;
    const VectorXd loads = force + *matrix_ * d;
    solution_ = solved_by_matrix(loads, d);
    const bool is_solved = solution_.interface.converged && !drifts_;
    if (!is_solved && !best)
      return is_leaning_;
    if (!is_solved)
      break;
    d = solution_.interface.increment;
    force = seen_.force(d);
    error = (force - loads + *matrix_ * d).template lpNorm<Eigen::Infinity>();
    parallel::from_first(std::span(&error, 1));
    if (seen_.is_within(d, error, tolerance_) && error < before)
      best = solution_;
  } while (!seen_.is_within(d, error, next_to_nothing * tolerance_) && error < before / 10);
  if (!best) {
    solution_.interface.converged = false;
    solution_.interface.residual =
        larger(solution_.interface.residual, error / seen_.largest_force());
    return false;
  }
  drifts_ = false;
  solution_ = *best;
  if (solution_.interface.increment != d)
    seen_.force(solution_.interface.increment);
  return true;
}

template <int dim>
bool ContactBySolutions<dim>::is_in_doubt() const {
  return is_leaning_ && may_have_slid(body_.nodal_forces().round_off, contact_.points(),
                                      contact_.couplings(), solution_);
}

// With these forces where the contact does not move [N]. All ranks go the first one's way: their
// processors may round otherwise.
template <int dim>
CoupledSolution ContactBySolutions<dim>::solved_by_matrix(const VectorXd &loads,
                                                          const VectorXd &start) {
  const InterfaceSettings settings{model_.asked.solver.tolerance,
                                   model_.asked.solver.max_iterations, !is_leaning_};
  const InterfaceProgramme programme{
      *matrix_, loads, contact_.points(), seen_.largest_force(), {}, seen_.error_of_matrix};
  const CoupledProgramme coupled{programme, contact_.couplings()};
  CoupledSolution found = is_leaning_ ? solve_leaning(coupled, start, settings)
                                      : solve_coupled(coupled, start, settings);
  InterfaceSolution &contact = found.interface;
  drifts_ = parallel::from_first(is_leaning_ && is_carried_off(programme, contact)) != 0 &&
            !is_balanced(contact);
  contact.converged = parallel::from_first(contact.converged) != 0;
  parallel::from_first(std::span(contact.increment.data(), std::size_t(contact.increment.size())));
  std::vector<int> status;
  for (const ContactStatus of_point : contact.status)
    status.push_back(static_cast<int>(of_point));
  parallel::from_first(std::span(status));
  std::ranges::transform(status, contact.status.begin(),
                         [](int of_point) { return static_cast<ContactStatus>(of_point); });
  return found;
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

// By the forces of the contact, along what only that holds. A body that nothing works on goes with
// its foundation, or stands where round-off puts it: that all its forces are round-off does not
// mean that it is lost.
template <int dim>
bool ContactBySolutions<dim>::is_balanced(const InterfaceSolution &found) const {
  if (found.force.size() != contact_.n_unknowns())  // nothing was found
    return false;
  RigidWork work = RigidWork::left_to_contact(model_);
  work.add_loads(model_, body_.loads());
  const VectorXd forces = -(contact_.directions() * found.force);
  work.add_at_contact(model_, forces);
  const double round_off =
      round_off_where_held(model_, time_, status_by_node(model_, contact_, found.status));
  const bool is_so = work.imbalance(RigidWork::uncertain, round_off) <=
                     RigidWork::allowed(model_.asked.solver, true);
  return parallel::from_first(is_so) != 0;
}

template <int dim>
std::string ContactBySolutions<dim>::carried_off() const {
  constexpr double counts = 1e-7;
  if (!is_leaning_)
    return "";
  const auto [largest, round_off] = body_.nodal_forces();
  const bool is_far = round_off > counts * larger(largest, body_.first_nodal_forces().largest);
  return drifts_ || (is_far && !is_balanced(solution_.interface))
             ? unheld_motions(model_, contact_, solution_.interface.status)
             : "";
}

// A few unknowns are worth a matrix, which takes as many solutions, if fewer do not help: 1,000
// with as many iterations as are allowed by default, and no more than need 32 MB.
template <int dim>
void ContactBySolutions<dim>::find_safely(const VectorXd &start, const Begin &begin) {
  constexpr Index at_most = 2000;
  const Index few = std::min(at_most, Index{10} * model_.asked.solver.max_iterations);
  needed_safe_stage_ |= !is_without_points();  // without them there is only the body to go on with
  begin();
  if (const Index n = contact_.n_unknowns(); n <= few && !has_no_matrix_) {
    if (!matrix_)
      solution_ = solve_from(start, static_cast<int>(n) / 4);
    const bool is_found = !matrix_ && !is_lost() && !is_in_doubt();
    if (is_found || find_by_matrix(start, begin))
      return;
    begin();
  }
  find_by_solutions(start);
}

// Every stage begins with the state that is predicted.
template <int dim>
bool ContactBySolutions<dim>::find() {
  const VectorXd start = seen_.unknowns();
  const std::vector<double> state(state_.begin(), state_.end());
  drifts_ = false;
  is_found_safely_ = !find_fast() || !carried_off().empty() || is_in_doubt();
  if (is_found_safely_)
    find_safely(start, [&] {
      std::copy(state.begin(), state.end(), state_.begin());
      seen_.take(start);
      seen_.begin_anew();
    });
  if (is_found_safely_ && is_lost())
    return false;
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
  count_.safe_steps += needed_safe_stage_;
  contact_.end_step(solution_, outcome);
  exchange_.end_step(state_, states(), outcome);
  return outcome;
}

template <int dim>
void ContactBySolutions<dim>::take_back() {
  count_.safe_steps -= needed_safe_stage_;
  contact_.take_back();
  exchange_.take_back();
}

template <int dim>
void ContactBySolutions<dim>::save(output::SavedNumbers &numbers) const {
  contact_.save(numbers);
  exchange_.save(numbers);
  if (matrix_)
    numbers.put("contact matrix", *matrix_);
}

template <int dim>
void ContactBySolutions<dim>::restore(const output::SavedNumbers &numbers) {
  contact_.restore(numbers);
  exchange_.restore(numbers);
  matrix_.reset();
  if (numbers.size("contact matrix") > 0) {
    matrix_.emplace(contact_.n_unknowns(), contact_.n_unknowns());
    numbers.fill("contact matrix", *matrix_);
  }
}

template class ContactBySolutions<2>;
template class ContactBySolutions<3>;

}  // namespace tourmaline::solve
