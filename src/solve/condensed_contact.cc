#include "solve/condensed_contact.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "body/prescribed.h"
#include "case/holding.h"
#include "dense/decompositions.h"
#include "larger.h"
#include "parallel/ranks.h"
#include "solve/exchange_programme.h"
#include "solve/first_places.h"
#include "solve/judgement.h"
#include "solve/leaning.h"
#include "solve/leaning_programme.h"
#include "solve/rigid_work.h"
#include "tourmaline/error.h"

namespace tourmaline::solve {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// From the first rank to the others.
void share(StepOutcome &outcome) {
  std::vector<double> numbers{static_cast<double>(outcome.newton_iterations), outcome.residual,
                              static_cast<double>(outcome.stage),
                              static_cast<double>(outcome.slip_jumped)};
  for (const auto status : outcome.status)
    numbers.push_back(static_cast<double>(status));
  for (const VectorXd &by_node :
       {outcome.contact_forces, outcome.friction_forces, outcome.friction_bound,
        outcome.accumulated_slip, outcome.heat_flow, outcome.friction_heat, outcome.charge_flow})
    numbers.insert(numbers.end(), by_node.begin(), by_node.end());
  parallel::from_first(std::span<double>(numbers));
  outcome.newton_iterations = static_cast<int>(numbers[0]);
  outcome.residual = numbers[1];
  outcome.stage = static_cast<ContactStage>(numbers[2]);
  outcome.slip_jumped = numbers[3] != 0;
  const double *next = &numbers[4];
  for (auto &status : outcome.status)
    status = static_cast<ContactStatus>(*next++);
  for (VectorXd *by_node : {&outcome.contact_forces, &outcome.friction_forces,
                            &outcome.friction_bound, &outcome.accumulated_slip, &outcome.heat_flow,
                            &outcome.friction_heat, &outcome.charge_flow}) {
    std::copy_n(next, by_node->size(), by_node->begin());
    next += by_node->size();
  }
}

// Where nothing acts on the body, nothing moves: from elsewhere Newton's method would come there by
// ever smaller steps, and end at forces that no balance can tell from real ones.
VectorXd unless_unloaded(VectorXd start, const VectorXd &force) {
  if (force.isZero(0))
    start.head(force.size()).setZero();
  return start;
}

}  // namespace

template <int dim>
CondensedContact<dim>::CondensedContact(const Model<dim> &model, const ConnectedBody<dim> &body)
    : model_(model),
      body_(body),
      left_to_contact_(casefile::left_to_contact(model.asked)),
      is_alone_(!resisted_by_contact_alone(model).empty()),
      is_prescribed_(body::mask_of(model.prescribed, model.n_unknowns())),
      nodes_(model, is_prescribed_),
      exchange_(model) {
  condense();
}

template <int dim>
void CondensedContact<dim>::condense() {
  parallel::on_first([&] { condense_onto_slips(); });
  error_ = error_of_slips();
}

template <int dim>
void CondensedContact<dim>::condense_onto_slips() {
  forget_matrices();
  last_increment_ = VectorXd::Zero(nodes_.n_unknowns());
  if (exchanges())
    return condense_exchanges();
  const Eigen::SparseMatrix<double> &directions = nodes_.directions();
  slip_stiffness_ = directions.transpose() * (body_.stiffness() * directions);
  slip_stiffness_ = (slip_stiffness_ + slip_stiffness_.transpose()).eval() / 2;
}

// Rows of S and T are displacements, then what is exchanged.
template <int dim>
void CondensedContact<dim>::condense_exchanges() {
  const MatrixXd &s = body_.stiffness();
  const Eigen::SparseMatrix<double> &directions = nodes_.directions();
  const Index n = directions.cols(), m = exchange_.size();
  const auto scale = exchange_.scale().asDiagonal();
  whole_stiffness_.resize(n + m, n + m);
  whole_stiffness_.topLeftCorner(n, n) =
      directions.transpose() *
      MatrixXd(s.topLeftCorner(directions.rows(), directions.rows()) * directions);
  whole_stiffness_.topRightCorner(n, m) =
      directions.transpose() * MatrixXd(s.topRightCorner(directions.rows(), m) * scale);
  whole_stiffness_.bottomLeftCorner(m, n) = whole_stiffness_.topRightCorner(n, m).transpose();
  whole_stiffness_.bottomRightCorner(m, m) = scale * s.bottomRightCorner(m, m) * scale;
  whole_stiffness_ = (whole_stiffness_ + whole_stiffness_.transpose()).eval() / 2;
  slip_stiffness_ = whole_stiffness_.topLeftCorner(n, n);
  // All or none: not quasi-definite it would be of no use.
  const dense::Cholesky factor(-whole_stiffness_.bottomRightCorner(m, m));
  negative_at_contact_ = factor.is_definite() ? static_cast<int>(m) : 0;
}

// What round-off of the size of S's entries does to the solution of T^T S T. Where that is singular
// by itself, as only the contact holds the body, it says nothing.
template <int dim>
double CondensedContact<dim>::error_of_slips() const {
  double error = 0;
  const std::vector<Index> entries = nodes_.movable();
  if (parallel::is_first() && !entries.empty() && left_to_contact_.empty())
    error = std::numeric_limits<double>::epsilon() /
            dense::inverse_condition(slip_stiffness_(entries, entries));
  parallel::from_first(std::span(&error, 1));
  return error;
}

template <int dim>
InterfaceSettings CondensedContact<dim>::settings(KeptFactor *factor) const {
  return {model_.asked.solver.tolerance, model_.asked.solver.max_iterations,
          left_to_contact_.empty(), factor};
}

template <int dim>
CoupledSolution CondensedContact<dim>::solve_programme(const InterfaceProgramme &programme,
                                                       const VectorXd &start,
                                                       const InterfaceSettings &settings) const {
  if (nodes_.is_coupled() && !left_to_contact_.empty())
    return solve_leaning({programme, nodes_.couplings()}, start, settings);
  return solve_coupled({programme, nodes_.couplings()}, start, settings);
}

// Of held exchanges each has a matrix of its own, of which nothing is kept.
template <int dim>
CoupledSolution CondensedContact<dim>::solve_with_exchange(double time, const VectorXd &s,
                                                           const VectorXd &start) {
  const MatrixXd &all = body_.stiffness();
  const Eigen::SparseMatrix<double> &directions = nodes_.directions();
  const Index n_rows = directions.rows(), n = directions.cols(), m = exchange_.size();
  const VectorXd resisted = all.leftCols(n_rows) * nodes_.stuck();
  const VectorXd terms = s.cwiseAbs().cwiseMax(resisted.cwiseAbs());
  VectorXd force(n + m);
  force << directions.transpose() * (s - resisted).head(n_rows),
      exchange_.scale().cwiseProduct((s - resisted).tail(m));
  const std::vector<ExchangePoint> exchanges = exchange_.points(nodes_);
  const ExchangeProgramme programme{
      {whole_stiffness_, force, nodes_.points(), terms.head(n_rows).maxCoeff(),
       exchange_.fields(n, exchange_.scale().cwiseProduct(terms.tail(m)))},
      nodes_.couplings(),
      exchanges};
  const auto solve_held = [&](const InterfaceProgramme &held, const VectorXd &from) {
    return solve_programme(held, from, settings(nullptr));
  };
  const VectorXd from = unless_unloaded(start, force.head(n));
  CoupledSolution solution =
      solve_exchanging(programme, from, settings(&whole_factor_), solve_held);
  // Newton's method on the whole may lose a body that only its contact holds; with what crosses
  // held, springs lead back.
  if (!left_to_contact_.empty() &&
      (!solution.interface.converged || is_carried_off(programme.whole, solution.interface)))
    solution = solve_exchanging(programme, from, settings(&whole_factor_), solve_held, false);
  require_solved(time, s, programme.whole, solution.interface);
  return solution;
}

template <int dim>
void CondensedContact<dim>::require_solved(double time, const VectorXd &s,
                                           const InterfaceProgramme &programme,
                                           const InterfaceSolution &solution) const {
  if (is_conclusive(model_, solution) && is_lost(time, s, programme, solution)) {
    const std::string unheld = unheld_motions(model_, nodes_, solution.status);
    let_go(time, unheld.empty() ? left_to_contact_ : unheld);
  }
  if (!solution.converged)
    give_up(time, solution);
}

template <int dim>
CoupledSolution CondensedContact<dim>::solve_contact(double time, const VectorXd &s,
                                                     const VectorXd &start) {
  if (exchanges())
    return solve_with_exchange(time, s, start);
  const VectorXd resisted = body_.stiffness() * nodes_.stuck();
  const VectorXd force = nodes_.directions().transpose() * (s - resisted);
  const double scale = larger(s.cwiseAbs().maxCoeff<Eigen::PropagateNaN>(),
                              resisted.cwiseAbs().maxCoeff<Eigen::PropagateNaN>());
  const InterfaceProgramme programme{slip_stiffness_, force, nodes_.points(), scale};
  CoupledSolution solution =
      solve_programme(programme, unless_unloaded(start, force), settings(&factor_));
  require_solved(time, s, programme, solution.interface);
  return solution;
}

// The displacements of the contact. Where they are the small difference of larger ones (of what
// sticking to a foundation that slips away, or closing a gap, would take), the programme is solved
// once more, and points that slip or are open are measured from where they were.
template <int dim>
VectorXd CondensedContact<dim>::sharpen(double time, const VectorXd &s, CoupledSolution &solution) {
  const Index n = nodes_.n_unknowns();
  if (nodes_.loses_digits(solution)) {
    nodes_.measure_from_before(solution);
    CoupledSolution sharp = solve_contact(time, s, solution.interface.increment);
    sharp.interface.iterations += solution.interface.iterations;
    sharp.stage = solution.stage;
    sharp.slip_jumped = solution.slip_jumped;
    solution = std::move(sharp);
  }
  // Adding the increment to the very values of the last step keeps a sticking point in its place
  // exactly.
  VectorXd c = nodes_.displacements(solution.interface.increment.head(n));
  nodes_.measure_from_stuck(solution);
  return c;
}

// A body that nothing works on goes with its foundation, or stands where round-off puts it; that
// all its forces are round-off does not mean that it is lost.
template <int dim>
bool CondensedContact<dim>::is_lost(double time, const VectorXd &s,
                                    const InterfaceProgramme &programme,
                                    const InterfaceSolution &solution) const {
  if (!is_alone_ || !is_carried_off(programme, solution))
    return false;
  const Eigen::SparseMatrix<double> &directions = nodes_.directions();
  const VectorXd forces =
      s.head(directions.rows()) - directions * solution.force.head(directions.cols());
  RigidWork work = RigidWork::left_to_contact(model_);
  work.add_at_contact(model_, forces);
  const double round_off = RigidWork::round_off(
      slip_stiffness_.diagonal().norm(),
      held_motion(model_, time, status_by_node(model_, nodes_, solution.status)));
  return !(work.imbalance(RigidWork::uncertain, round_off) <=
           RigidWork::allowed(model_.asked.solver, true));
}

template <int dim>
void CondensedContact<dim>::give_up(double time, const InterfaceSolution &solution) const {
  if (!std::isfinite(solution.residual))
    throw SolveError(fmt::format(
        "the contact problem at t = {:g} s has forces that are not finite numbers: look "
        "for a load, a prescribed value or a constant that is too large by many powers "
        "of ten, often a unit",
        time));
  if (!left_to_contact_.empty())
    give_up_leaning(time, solution, left_to_contact_);
  if (!solution.is_definite || !(error_ <= 1e-2))
    throw SolveError(fmt::format(
        "the contact problem at t = {:g} s is too badly conditioned to be solved: round-off leaves "
        "no digit of the slips certain; {}",
        time, ill_conditioned_advice));
  std::set<std::size_t> nodes;  // one node may have several unknowns
  for (const std::size_t i : solution.unsettled)
    nodes.insert(nodes_.node_of(i));
  const std::vector<std::size_t> unsettled(nodes.begin(), nodes.end());
  const std::string where =
      unsettled.empty() ? "what crosses of heat or charge by the contact's state is unsettled"
                        : fmt::format("{} nodes are unsettled, among them{}", unsettled.size(),
                                      first_places(unsettled.size(), [&](std::size_t i) {
                                        return model_.interface[unsettled[i]].point;
                                      }));
  throw UnsettledStep(fmt::format(
      "the contact iteration did not converge at t = {:g} s: residual {:.3g} of the largest force "
      "after {} iterations, wanted {:.3g}; {}; raise solver.max_iterations or solver.tolerance, or "
      "take smaller time steps{}",
      time, solution.residual, solution.iterations, model_.asked.solver.tolerance, where,
      exchanges() ? ", or let conductances fade over a longer ramp" : ""));
}

// On the first rank, which holds the condensed stiffness: c and what is known with it.
template <int dim>
void CondensedContact<dim>::advance_on_first(double time, const VectorXd &s,
                                             std::span<const double> before,
                                             std::span<const double> state, VectorXd &c,
                                             StepOutcome &outcome) {
  nodes_.begin_step(time, before, state);
  exchange_.begin_step(time, state);
  VectorXd start(last_increment_.size() + exchange_.size());
  start << last_increment_, exchange_.entries(before);
  CoupledSolution solution = solve_contact(time, s, start);
  const VectorXd displacements = sharpen(time, s, solution);
  const VectorXd crossing = solution.interface.increment.tail(exchange_.size());
  exchange_.end_step(
      exchange_.scale().cwiseProduct(crossing),
      [&](std::size_t node) { return nodes_.state_for_exchange(node, solution); }, outcome);
  solution.interface.increment.conservativeResize(nodes_.n_unknowns());
  solution.interface.force.conservativeResize(nodes_.n_unknowns());
  last_increment_ = solution.interface.increment;
  c << displacements, exchange_.scale().cwiseProduct(crossing);
  const VectorXd held = body_.stiffness() * c - s;
  outcome.contact_forces = held.head(nodes_.directions().rows());
  outcome.slip_jumped = solution.slip_jumped;
  nodes_.end_step(solution, outcome);
}

template <int dim>
StepOutcome CondensedContact<dim>::advance(double time, const VectorXd &s,
                                           std::span<const double> before,
                                           std::span<const double> state, VectorXd &c) {
  StepOutcome outcome;
  outcome.contact_forces = outcome.friction_forces = VectorXd::Zero(nodes_.directions().rows());
  exchange_.prepare(outcome);
  outcome.status.resize(model_.interface.size());
  const auto n_nodes = static_cast<Index>(model_.interface.size());
  if (nodes_.is_coupled())
    outcome.friction_bound = VectorXd::Zero(n_nodes);
  if (model_.laws.remembers_slip())
    outcome.accumulated_slip = VectorXd::Zero(n_nodes);
  parallel::on_first([&] { advance_on_first(time, s, before, state, c, outcome); });
  share(outcome);
  return outcome;
}

template <int dim>
VectorXd CondensedContact<dim>::reactions(const StepOutcome &outcome) const {
  VectorXd q = outcome.contact_forces;
  if (exchanges()) {
    q.conservativeResize(q.size() + exchange_.size());
    q.tail(exchange_.size()) = exchange_.rows(outcome);
  }
  return q;
}

template <int dim>
void CondensedContact<dim>::take_back() {
  nodes_.take_back();
  exchange_.take_back();
}

template <int dim>
void CondensedContact<dim>::save(output::SavedNumbers &numbers) const {
  numbers.put("last increment", last_increment_);
  nodes_.save(numbers);
  exchange_.save(numbers);
}

template <int dim>
void CondensedContact<dim>::restore(const output::SavedNumbers &numbers) {
  if (!parallel::is_first())
    return;
  numbers.fill("last increment", last_increment_);
  nodes_.restore(numbers);
  exchange_.restore(numbers);
}

template class CondensedContact<2>;
template class CondensedContact<3>;

}  // namespace tourmaline::solve
