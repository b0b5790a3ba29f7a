#include "condensation/condensed_body.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "body/backward_error.h"
#include "condensation/multifrontal.h"
#include "condensation/mumps_factorisation.h"
#include "condensation/ordering.h"
#include "condensation/step_matrix.h"
#include "gmres.h"
#include "larger.h"
#include "parallel/ranks.h"
#include "stopwatch.h"
#include "tourmaline/error.h"

namespace tourmaline::condensation {

using body::Fields;
using body::Node;
using body::unknown;
using Eigen::Index;
using Eigen::VectorXd;

template <int dim>
CondensedBody<dim>::CondensedBody(const body::Discretisation<dim> &body,
                                  const body::Operator<dim> &op, double step,
                                  const std::vector<body::Prescribed> &prescribed,
                                  const std::vector<std::size_t> &contact,
                                  const FactorisationChoice &choice)
    : CondensedBody(op, step) {
  if (!body.sharing().is_whole())
    throw std::logic_error("a factorisation needs all nodes on every rank");
  number(prescribed, contact);
  // MUMPS on two ranks waits for ever where nothing is eliminated.
  if (parallel::n_ranks() > 1 && contact_variables_.size() == unknown_of_.size())
    throw CaseError(
        "[mesh] no unknown of the body is free beside those of its contact: such a mesh is not "
        "available on several MPI ranks; start the program without mpirun, or take finer cells");
  Stopwatch watch;
  factorise(body, choice);
  statistics_ = factorisation_->statistics();
  // With the ordering, the matrix in its order, and an own factorisation that met a weak pivot.
  statistics_.analyse_seconds = watch.lap() - statistics_.factorise_seconds;
  const auto n =
      static_cast<Eigen::Index>(parallel::is_first() ? contact_variables_.size() : std::size_t{0});
  stiffness_ = Eigen::Map<const Eigen::MatrixXd>(factorisation_->schur_complement().data(), n, n);
  for (Eigen::Index j = 0; j < n; ++j)
    for (Eigen::Index i = 0; i < n; ++i)
      stiffness_(i, j) /= contact_scale(i) * contact_scale(j);
}

template <int dim>
auto CondensedBody<dim>::plan(const body::Operator<dim> &op, double step,
                              const std::vector<body::Prescribed> &prescribed,
                              const std::vector<std::size_t> &contact) -> Plan {
  CondensedBody body(op, step);
  body.number(prescribed, contact);
  const std::vector<double> scales = body.scales();
  const Elimination elimination(step_matrix(op, step, body.nodes_in_order(), body.unknown_of_,
                                            scales, body.is_contact_variable_));
  Plan plan{body.n_unknowns(), contact.size(), elimination.fronts.size()};
  for (const Front &front : elimination.fronts) {
    plan.entries += front.entries();
    plan.operations += front.operations();
  }
  return plan;
}

template <int dim>
void CondensedBody<dim>::number(const std::vector<body::Prescribed> &prescribed,
                                const std::vector<std::size_t> &contact) {
  const std::size_t n_unknowns = operator_.graph().n_nodes() * Fields<dim>::count;
  is_prescribed_ = body::mask_of(prescribed, n_unknowns);
  std::vector<bool> taken_out = is_prescribed_;
  for (const std::size_t i : contact)
    taken_out[i] = false;
  variable_of_.assign(n_unknowns, -1);
  for (std::size_t i = 0; i < n_unknowns; ++i) {
    if (taken_out[i]) {
      prescribed_.push_back(i);
      continue;
    }
    variable_of_[i] = static_cast<int>(unknown_of_.size());
    unknown_of_.push_back(i);
    n_electric_and_thermal_ += body::field_of<dim>(i) > 0;
  }
  n_electric_and_thermal_inside_ = n_electric_and_thermal_;
  for (const std::size_t i : contact) {
    contact_variables_.push_back(variable_of_[i]);
    n_electric_and_thermal_inside_ -= body::field_of<dim>(i) > 0;
  }
  is_contact_variable_.assign(unknown_of_.size(), false);
  for (const int v : contact_variables_)
    is_contact_variable_[v] = true;
}

template <int dim>
std::vector<double> CondensedBody<dim>::scales() const {
  std::vector<double> scales;
  for (const std::size_t i : unknown_of_)
    scales.push_back(scale(i));
  return scales;
}

template <int dim>
void CondensedBody<dim>::factorise(const body::Discretisation<dim> &body,
                                   const FactorisationChoice &choice) {
  const std::vector<double> scales = this->scales();
  const std::vector<Node> node_at = nodes_in_order();
  std::string reason;
  if (choice.by != Factoriser::mumps && parallel::n_ranks() == 1)
    try {
      factorisation_ = std::make_unique<Multifrontal>(
          step_matrix(operator_, step_, node_at, unknown_of_, scales, is_contact_variable_),
          contact_variables_, choice.threads);
      return;
    } catch (const WeakPivot &weak) {
      reason = weak_pivot_in_words(body, weak.variable);
      if (choice.by == Factoriser::own)
        throw SolveError("the body's equations have no factorisation without pivoting: " + reason +
                         "; solver.factorisation = \"automatic\" goes on with MUMPS");
    }
  auto by_mumps = std::make_unique<MumpsFactorisation>(
      scaled_matrix(operator_, step_, variable_of_, scales), elimination_order(node_at),
      contact_variables_, choice.threads);
  by_mumps->set_reason(std::move(reason));
  factorisation_ = std::move(by_mumps);
}

template <int dim>
std::string CondensedBody<dim>::weak_pivot_in_words(const body::Discretisation<dim> &body,
                                                    int variable) const {
  const std::size_t i = unknown_of_[variable];
  const Vector3 &p = body.points()[i / Fields<dim>::count];
  return fmt::format("round-off leaves no pivot of the right sign for {} at ({:g}, {:g}, {:g})",
                     body::column_of<dim>(static_cast<int>(i % Fields<dim>::count)), p[0], p[1],
                     p[2]);
}

// Nested dissection.
template <int dim>
std::vector<Node> CondensedBody<dim>::nodes_in_order() const {
  const std::size_t n_nodes = operator_.graph().n_nodes();
  NodeUnknowns unknowns{std::vector<int>(n_nodes, 0), std::vector<int>(n_nodes, 0)};
  for (std::size_t v = 0; v < unknown_of_.size(); ++v)
    ++(is_contact_variable(v) ? unknowns.kept
                              : unknowns.eliminated)[unknown_of_[v] / Fields<dim>::count];

  const std::vector<int> node_position = nested_dissection(operator_.graph(), unknowns, dim);
  std::vector<Node> node_at(n_nodes);
  for (Node i = 0; i < n_nodes; ++i)
    node_at[node_position[i]] = i;
  return node_at;
}

// Node by node, each with its unknowns; those of the contact last.
template <int dim>
std::vector<int> CondensedBody<dim>::elimination_order(const std::vector<Node> &node_at) const {
  std::vector<int> position(unknown_of_.size());
  int next = 0;
  for (const Node node : node_at)
    for (int c = 0; c < Fields<dim>::count; ++c)
      if (const int v = variable_of_[unknown<dim>(node, c)]; v >= 0 && !is_contact_variable(v))
        position[v] = next++;
  for (const int v : contact_variables_)
    position[v] = next++;
  return position;
}

template <int dim>
Eigen::VectorXd CondensedBody<dim>::reduce(std::span<const double> right_side,
                                           std::span<const double> state) {
  if (is_refined())
    return reduce_refined(right_side, state);
  lifted_.assign(right_side.begin(), right_side.end());
  operator_.subtract_columns(prescribed_, step_, state, lifted_);
  right_side_.resize(unknown_of_.size());
  for (std::size_t v = 0; v < unknown_of_.size(); ++v)
    right_side_[v] = lifted_[unknown_of_[v]] * scale(unknown_of_[v]);
  const std::vector<double> reduced = factorisation_->reduce(right_side_);
  Eigen::VectorXd s(static_cast<Eigen::Index>(reduced.size()));
  for (Eigen::Index i = 0; i < s.size(); ++i)
    s[i] = reduced[i] / contact_scale(i);
  return s;
}

template <int dim>
void CondensedBody<dim>::expand(const Eigen::VectorXd &c, std::span<double> state) {
  if (is_refined()) {
    for (std::size_t v = 0; v < unknown_of_.size(); ++v)
      state[unknown_of_[v]] = inside_[unknown_of_[v]];
    impose(c, state);
    solve_refined(given_, state);
    return;
  }
  std::vector<double> scaled(c.size());
  for (Eigen::Index i = 0; i < c.size(); ++i)
    scaled[i] = c[i] / contact_scale(i);
  factorisation_->expand(scaled);
  for (std::size_t v = 0; v < unknown_of_.size(); ++v)
    state[unknown_of_[v]] = right_side_[v] * scale(unknown_of_[v]);
  // What was prescribed or decided at the contact is exact, not a round trip through the scaling.
  for (Eigen::Index i = 0; i < c.size(); ++i)
    state[unknown_of_[contact_variables_[i]]] = c[i];
}

template <int dim>
double CondensedBody<dim>::backward_error(std::span<const double> right_side,
                                          std::span<const double> state,
                                          const Eigen::VectorXd &q) const {
  std::vector<double> force(right_side.begin(), right_side.end());
  for (Eigen::Index i = 0; i < q.size(); ++i)
    force[unknown_of_[contact_variables_[i]]] += q[i];
  std::vector<double> residual(state.size()), scales(state.size(), 0.);
  operator_.multiply(step_, state, residual);
  for (std::size_t i = 0; i < residual.size(); ++i)
    residual[i] = force[i] - residual[i];
  for (const std::size_t i : unknown_of_)
    scales[i] = is_prescribed_[i] ? 0 : scale(i);
  return body::backward_error(operator_, step_, scales, residual, force, state);
}

// Iterative refinement.

namespace {

constexpr int corrections = 6, products_a_correction = 40;
constexpr double reduction = 1e-8;  // of a correction's preconditioned residual
constexpr double enough = 1e-15;    // a correction that changes no digit

}  // namespace

// b - K x in scaled variables, 0 at those of the contact.
template <int dim>
VectorXd CondensedBody<dim>::residual_inside(const body::CellProducts<dim> &cells,
                                             std::span<const double> right_side,
                                             std::span<const double> state) const {
  std::vector<double> product(state.size());
  cells.multiply(step_, state, product);
  VectorXd residual = VectorXd::Zero(static_cast<Index>(unknown_of_.size()));
  for (std::size_t v = 0; v < unknown_of_.size(); ++v)
    if (const std::size_t i = unknown_of_[v]; !is_contact_variable(v))
      residual[static_cast<Index>(v)] = (right_side[i] - product[i]) * scale(i);
  return residual;
}

// By the factor: an approximate inverse.
template <int dim>
VectorXd CondensedBody<dim>::solve_inside(const VectorXd &residual) {
  right_side_.assign(residual.begin(), residual.end());
  factorisation_->reduce(right_side_);
  factorisation_->expand(std::vector<double>(contact_variables_.size(), 0.));
  VectorXd x = Eigen::Map<const VectorXd>(right_side_.data(), residual.size());
  for (const int v : contact_variables_)
    x[v] = 0;
  return x;
}

template <int dim>
VectorXd CondensedBody<dim>::product_inside(const VectorXd &x) const {
  std::vector<double> state(variable_of_.size(), 0.);
  const std::vector<double> zero(state.size(), 0.);
  for (std::size_t v = 0; v < unknown_of_.size(); ++v)
    if (!is_contact_variable(v))
      state[unknown_of_[v]] = x[static_cast<Index>(v)] * scale(unknown_of_[v]);
  return -residual_inside(*cells_, zero, state);
}

template <int dim>
double CondensedBody<dim>::relative_size(const VectorXd &correction,
                                         std::span<const double> state) const {
  std::vector<double> change(state.size(), 0.);
  for (std::size_t v = 0; v < unknown_of_.size(); ++v)
    change[unknown_of_[v]] = correction[static_cast<Index>(v)] * scale(unknown_of_[v]);
  return body::relative_size<dim>(operator_.sharing(), change, state, scale_);
}

template <int dim>
double CondensedBody<dim>::forward_error(const body::CellProducts<dim> &cells,
                                         std::span<const double> right_side,
                                         std::span<const double> state) {
  return relative_size(solve_inside(residual_inside(cells, right_side, state)), state);
}

// Corrects what `state` has inside, for its c and prescribed values.
template <int dim>
void CondensedBody<dim>::solve_refined(std::span<const double> right_side,
                                       std::span<double> state) {
  double before = std::numeric_limits<double>::infinity();
  for (int k = 0; k < corrections; ++k) {
    const VectorXd correction =
        gmres([&](const VectorXd &x) { return product_inside(x); },
              [&](const VectorXd &r) { return solve_inside(r); },
              residual_inside(*cells_, right_side, state), reduction, products_a_correction);
    for (std::size_t v = 0; v < unknown_of_.size(); ++v)
      state[unknown_of_[v]] += correction[static_cast<Index>(v)] * scale(unknown_of_[v]);
    const double size = relative_size(correction, state);
    const bool is_last = size <= enough || k + 1 == corrections || !(size < before / 2);
    if (is_last) {
      left_by_refinement_ = larger(left_by_refinement_, size);
      return;
    }
    before = size;
  }
}

template <int dim>
void CondensedBody<dim>::impose(const VectorXd &c, std::span<double> state) const {
  for (Index i = 0; i < c.size(); ++i)
    state[unknown_of_[contact_variables_[i]]] = c[i];
}

// K x in the rows of c.
template <int dim>
VectorXd CondensedBody<dim>::contact_rows(std::span<const double> state) const {
  std::vector<double> product(state.size());
  cells_->multiply(step_, state, product);
  VectorXd rows(static_cast<Index>(contact_variables_.size()));
  for (Index i = 0; i < rows.size(); ++i)
    rows[i] = product[unknown_of_[contact_variables_[i]]];
  return rows;
}

template <int dim>
void CondensedBody<dim>::refine(const body::CellProducts<dim> &cells) {
  cells_ = &cells;
  const auto n = static_cast<Index>(contact_variables_.size());
  const std::vector<double> zero(variable_of_.size(), 0.);
  Eigen::MatrixXd columns(n, n);
  for (Index j = 0; j < n; ++j) {
    std::vector<double> x(variable_of_.size(), 0.);
    impose(VectorXd::Unit(n, j), x);
    solve_refined(zero, x);
    columns.col(j) = contact_rows(x);
  }
  if (stiffness_.size() > 0)  // on the first rank
    stiffness_ = (columns + columns.transpose()) / 2;
}

template <int dim>
VectorXd CondensedBody<dim>::reduce_refined(std::span<const double> right_side,
                                            std::span<const double> state) {
  given_.assign(right_side.begin(), right_side.end());
  inside_.assign(state.begin(), state.end());
  impose(VectorXd::Zero(static_cast<Index>(contact_variables_.size())), inside_);
  solve_refined(given_, inside_);
  VectorXd s = -contact_rows(inside_);
  for (Index i = 0; i < s.size(); ++i)
    s[i] += given_[unknown_of_[contact_variables_[i]]];
  return s;
}

template class CondensedBody<2>;
template class CondensedBody<3>;

}  // namespace tourmaline::condensation
