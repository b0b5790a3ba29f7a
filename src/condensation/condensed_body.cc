#include "tourmaline/condensation/condensed_body.h"

#include <algorithm>
#include <cmath>

#include "tourmaline/body/backward_error.h"
#include "tourmaline/condensation/ordering.h"
#include "tourmaline/parallel/ranks.h"

namespace tourmaline::condensation {

using body::Fields;
using body::Node;
using body::unknown;

template <int dim>
CondensedBody<dim>::CondensedBody(const body::Operator<dim> &op, double step,
                                  const std::vector<body::Prescribed> &prescribed,
                                  const std::vector<Node> &contact_nodes, int threads)
    : operator_(op), step_(step) {
  number(prescribed, contact_nodes);
  scale_fields();
  std::vector<double> scales;
  for (const std::size_t i : unknown_of_)
    scales.push_back(scale(i));
  factorisation_.emplace(scaled_matrix(op, step, variable_of_, scales), elimination_order(),
                         contact_variables_, threads);
  const auto n =
      static_cast<Eigen::Index>(parallel::is_first() ? contact_variables_.size() : std::size_t{0});
  stiffness_ = Eigen::Map<const Eigen::MatrixXd>(factorisation_->schur_complement().data(), n, n);
  for (Eigen::Index j = 0; j < n; ++j)
    for (Eigen::Index i = 0; i < n; ++i)
      stiffness_(i, j) /= scale_[i % dim] * scale_[j % dim];
}

template <int dim>
void CondensedBody<dim>::number(const std::vector<body::Prescribed> &prescribed,
                                const std::vector<Node> &contact_nodes) {
  const std::size_t n_unknowns = operator_.graph().n_nodes() * Fields<dim>::count;
  std::vector<bool> taken_out(n_unknowns, false);
  for (const body::Prescribed &p : prescribed)
    taken_out[p.unknown] = true;
  for (const Node node : contact_nodes)
    for (int c = 0; c < dim; ++c)
      taken_out[unknown<dim>(node, c)] = false;
  variable_of_.assign(n_unknowns, -1);
  for (std::size_t i = 0; i < n_unknowns; ++i) {
    if (taken_out[i]) {
      prescribed_.push_back(i);
      continue;
    }
    variable_of_[i] = static_cast<int>(unknown_of_.size());
    unknown_of_.push_back(i);
    n_electric_and_thermal_ += i % Fields<dim>::count >= dim;
  }
  for (const Node node : contact_nodes)
    for (int c = 0; c < dim; ++c)
      contact_variables_.push_back(variable_of_[unknown<dim>(node, c)]);
}

template <int dim>
void CondensedBody<dim>::scale_fields() {
  const std::vector<double> diagonal = operator_.diagonal(step_);
  std::array<double, Fields<dim>::count> largest{};
  for (std::size_t i = 0; i < diagonal.size(); ++i)
    largest[i % Fields<dim>::count] =
        std::max(largest[i % Fields<dim>::count], std::abs(diagonal[i]));
  const double mechanical = *std::max_element(largest.begin(), largest.begin() + dim);
  std::fill(largest.begin(), largest.begin() + dim, mechanical);
  for (int c = 0; c < Fields<dim>::count; ++c)
    scale_[c] = 1 / std::sqrt(largest[c]);
}

// Nodes in the order of nested dissection, each with its unknowns; the contact displacements last.
template <int dim>
std::vector<int> CondensedBody<dim>::elimination_order() const {
  std::vector<bool> condensed(unknown_of_.size(), false);
  for (const int v : contact_variables_)
    condensed[v] = true;
  const std::size_t n_nodes = operator_.graph().n_nodes();
  std::vector<int> unknowns(n_nodes, 0);
  for (std::size_t v = 0; v < unknown_of_.size(); ++v)
    unknowns[unknown_of_[v] / Fields<dim>::count] += !condensed[v];

  const std::vector<int> node_position = nested_dissection(operator_.graph(), unknowns);
  std::vector<Node> node_at(n_nodes);
  for (Node i = 0; i < n_nodes; ++i)
    node_at[node_position[i]] = i;

  std::vector<int> position(unknown_of_.size());
  int next = 0;
  for (const Node node : node_at)
    for (int c = 0; c < Fields<dim>::count; ++c)
      if (const int v = variable_of_[unknown<dim>(node, c)]; v >= 0 && !condensed[v])
        position[v] = next++;
  for (const int v : contact_variables_)
    position[v] = next++;
  return position;
}

template <int dim>
Eigen::VectorXd CondensedBody<dim>::reduce(std::span<const double> right_side,
                                           std::span<const double> state) {
  lifted_.assign(right_side.begin(), right_side.end());
  operator_.subtract_columns(prescribed_, step_, state, lifted_);
  right_side_.resize(unknown_of_.size());
  for (std::size_t v = 0; v < unknown_of_.size(); ++v)
    right_side_[v] = lifted_[unknown_of_[v]] * scale(unknown_of_[v]);
  const std::vector<double> reduced = factorisation_->reduce(right_side_);
  Eigen::VectorXd s(static_cast<Eigen::Index>(reduced.size()));
  for (Eigen::Index i = 0; i < s.size(); ++i)
    s[i] = reduced[i] / scale_[i % dim];
  return s;
}

template <int dim>
void CondensedBody<dim>::expand(const Eigen::VectorXd &c, std::span<double> state) {
  std::vector<double> scaled(c.size());
  for (Eigen::Index i = 0; i < c.size(); ++i)
    scaled[i] = c[i] / scale_[i % dim];
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
    scales[i] = scale(i);
  return body::backward_error(operator_, step_, scales, residual, force, state);
}

template class CondensedBody<2>;
template class CondensedBody<3>;

}  // namespace tourmaline::condensation
