#include "solve/contact_by_solutions.h"

#include <algorithm>
#include <limits>
#include <string>

#include "solve/body_by_solutions.h"
#include "solve/contact_nodes.h"
#include "solve/coupled_programme.h"
#include "solve/held_exchanges.h"
#include "solve/iterative_route.h"
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

template <int dim>
class ContactBySolutions : public IterativeRoute<dim> {
 public:
  explicit ContactBySolutions(const Model<dim> &model)
      : IterativeRoute<dim>(model),
        contact_(model, this->is_prescribed_),
        exchange_(model),
        seen_(model, this->is_prescribed_, body_, contact_, !left_to_contact_.empty()) {}

  VectorXd accumulated_slip() const override { return contact_.accumulated_slip(); }

 private:
  using IterativeRoute<dim>::model_;
  using IterativeRoute<dim>::body_;
  using IterativeRoute<dim>::time_;
  using IterativeRoute<dim>::state_;
  using IterativeRoute<dim>::iterations_;
  using IterativeRoute<dim>::so_far_;
  using IterativeRoute<dim>::left_to_contact_;
  using IterativeRoute<dim>::contact_tolerance;

  void begin_contact(std::span<const double> before) override {
    contact_.begin_step(time_, before, state_);
    exchange_.begin_step(time_, state_);
    seen_.begin_step(time_, state_, contact_tolerance());
  }
  void settle() override;
  void settle_contact();
  void find();
  std::vector<double> freed(std::vector<double> residual) const override {
    return seen_.freed(std::move(residual));
  }
  void set_contact() override { body_.system().set_contact(seen_.held()); }
  StepOutcome outcome() override;
  void take_contact_back() override {
    contact_.take_back();
    exchange_.take_back();
  }
  std::string unheld() const override {
    return unheld_motions(model_, contact_, solution_.interface.status);
  }
  void save_contact(output::SavedNumbers &numbers) const override {
    contact_.save(numbers);
    exchange_.save(numbers);
  }
  void restore_contact(const output::SavedNumbers &numbers) override {
    contact_.restore(numbers);
    exchange_.restore(numbers);
  }

  StateAtNode states() const {
    return [this](std::size_t node) { return contact_.state_for_exchange(node, solution_); };
  }
  CoupledContact coupled() { return {seen_, contact_.points(), contact_.couplings()}; }
  bool find_fast();
  bool newton_step(const ContactTangent &tangent, std::vector<double> residual);
  CoupledSolution solve_from(const VectorXd &start);
  void find_safely(const VectorXd &start);

  ContactNodes<dim> contact_;
  HeldExchanges<dim> exchange_;
  BodyBySolutions<dim> seen_;  // by the contact
  CoupledSolution solution_;   // of the step at hand
};

// False where friction is too stiff for the linear iteration.
template <int dim>
bool ContactBySolutions<dim>::newton_step(const ContactTangent &tangent,
                                          std::vector<double> residual) {
  constexpr double reduction = 1e-2;     // what is left, the next iteration takes
  constexpr std::size_t tiresome = 100;  // linear iterations
  const std::size_t before = so_far_.krylov_iterations;
  return seen_.newton_step(tangent, std::move(residual), reduction) &&
         so_far_.krylov_iterations - before <= tiresome;
}

// Newton's method on all unknowns at once, in which body and contact settle together. It may cycle;
// false when it has gained nothing in a while.
template <int dim>
bool ContactBySolutions<dim>::find_fast() {
  constexpr int patience = 10, most = 30;
  const NaturalMap map(coupled(), 1);
  Progress progress;
  for (int k = 0; k <= most && k - progress.last_gain() < patience; ++k) {
    const NaturalMap::Place x = seen_.look();
    const ContactTangent tangent = map.tangent(x);
    std::vector<double> residual = freed(body_.residual());
    const double worst = map.residual(x);
    const bool contact_is_solved = worst <= contact_tolerance();
    if (k > 0 && contact_is_solved && body_.is_solved(residual)) {
      if (tangent.known.isZero(0)) {
        solution_ = map.solution(x);
        return true;
      }
      seen_.put(x.d + tangent.known);  // held points exactly where they are held
      continue;
    }
    progress.see(k, worst, contact_is_solved ? std::optional(body_.lack()) : std::nullopt);
    if (!newton_step(tangent, std::move(residual)))
      return false;
  }
  return false;
}

template <int dim>
CoupledSolution ContactBySolutions<dim>::solve_from(const VectorXd &start) {
  seen_.begin_anew();
  const InterfaceSettings settings{contact_tolerance(), model_.asked.solver.max_iterations,
                                   left_to_contact_.empty()};
  return solve_coupled(coupled(), start, settings);
}

// Where only the contact holds the body, a linear system on the way may have no solution. Weak
// springs between contact and foundation lead to where the contact holds.
template <int dim>
void ContactBySolutions<dim>::find_safely(const VectorXd &start) {
  ++so_far_.safe_steps;
  solution_ = solve_from(start);
  VectorXd sprung = start;
  for (const double weak : {1e-2, 1e-4, 1e-6}) {
    if (solution_.interface.converged || left_to_contact_.empty())
      break;
    seen_.set_springs(weak);
    sprung = solve_from(sprung).interface.increment;
    seen_.set_springs(0);
    solution_ = solve_from(sprung);
  }
}

// What crosses the contact by its state is held, the step solved, and so on.
template <int dim>
void ContactBySolutions<dim>::settle() {
  seen_.forget_iterations();
  do {
    body_.hold(exchange_);
    settle_contact();
  } while (!exchange_.is_empty() &&
           !exchange_.settle(time_, state_, states(), contact_tolerance()));
  if (!exchange_.is_empty())
    solution_.stage = ContactStage::fixed_point;
}

// Where the displacements are the small difference of larger ones, once more with points that slip
// or are open measured from where they were.
template <int dim>
void ContactBySolutions<dim>::settle_contact() {
  find();
  if (!contact_.loses_digits(solution_))
    return;
  const ContactStage stage = solution_.stage;
  contact_.measure_from_before(solution_);
  seen_.put(solution_.interface.increment);
  find();
  contact_.measure_from_stuck(solution_);
  seen_.take(solution_.interface.increment);
  solution_.stage = stage;
}

// Both stages begin with the state that is predicted.
template <int dim>
void ContactBySolutions<dim>::find() {
  const VectorXd start = seen_.unknowns();
  const std::vector<double> state(state_.begin(), state_.end());
  const bool is_found = find_fast();
  if (!is_found) {
    std::copy(state.begin(), state.end(), state_.begin());
    find_safely(start);
  }
  iterations_ = seen_.iterations();
  if (!is_found && !solution_.interface.converged)
    this->give_up_contact(solution_.interface, [&](std::size_t point) {
      return model_.interface[contact_.node_of(point)].point;
    });
  if (!contact_.is_coupled())
    solution_.stage = ContactStage::convex;
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
  solution_.interface.iterations = iterations_;
  contact_.end_step(solution_, outcome);
  exchange_.end_step(state_, states(), outcome);
  return outcome;
}

}  // namespace

template <int dim>
std::unique_ptr<Route> contact_by_solutions(const Model<dim> &model) {
  return std::make_unique<ContactBySolutions<dim>>(model);
}

template std::unique_ptr<Route> contact_by_solutions<2>(const Model<2> &);
template std::unique_ptr<Route> contact_by_solutions<3>(const Model<3> &);

}  // namespace tourmaline::solve
