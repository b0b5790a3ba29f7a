#include "solve/connected_body.h"

#include "parallel/ranks.h"
#include "solve/electrodes.h"
#include "tourmaline/error.h"

namespace tourmaline::solve {

using body::Fields;
using body::unknown;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

double dot(std::span<const double> a, std::span<const double> b) {
  return Eigen::Map<const VectorXd>(a.data(), static_cast<Index>(a.size()))
      .dot(Eigen::Map<const VectorXd>(b.data(), static_cast<Index>(b.size())));
}

}  // namespace

template <int dim>
ConnectedBody<dim>::ConnectedBody(const Model<dim> &model)
    : model_(model),
      contact_(contact_unknowns(model, exchange_sites(model))),
      body_(model.body, model.op, model.step, model.prescribed, contact_,
            condensation::choice_of(model.asked.solver)),
      circuit_(model.asked.electrodes, model.step),
      history_(model) {
  if (circuit_.free().empty())
    return;
  std::vector<bool> in_contact(model.n_unknowns(), false);
  for (const std::size_t i : contact_)
    in_contact[i] = true;
  for (const body::Prescribed &p : model.prescribed)
    if (!in_contact[p.unknown])
      lifted_.push_back(p.unknown);
  add_responses();
}

template <int dim>
void ConnectedBody<dim>::begin(std::span<const double> settled) {
  history_.begin(settled);
}

template <int dim>
void ConnectedBody<dim>::add_responses() {
  const auto m = static_cast<Index>(circuit_.free().size());
  const std::vector<double> nothing(model_.n_unknowns(), 0.);
  coupling_.resize(static_cast<Index>(contact_.size()), m);
  for (Index e = 0; e < m; ++e) {
    std::vector<double> psi = nothing;
    for (const body::Node node : model_.electrodes[circuit_.free()[e]])
      psi[unknown<dim>(node, Fields<dim>::potential)] = 1;
    body_.reduce(nothing, psi);
    body_.expand(VectorXd::Zero(coupling_.rows()), psi);
    std::vector<double> reaction = product(psi);
    for (std::size_t i = 0; i < contact_.size(); ++i)
      coupling_(static_cast<Index>(i), e) = -reaction[contact_[i]];
    response_.push_back(std::move(psi));
    reaction_.push_back(std::move(reaction));
  }
  MatrixXd capacitance(m, m);
  for (Index e = 0; e < m; ++e)
    for (Index f = 0; f < m; ++f)
      capacitance(e, f) = -dot(response_[e], reaction_[f]);
  admittance_ =
      dense::Cholesky((capacitance + capacitance.transpose()) / 2 + circuit_.admittance());
  if (!admittance_.is_definite())
    throw SolveError(
        "the charges on the electrodes do not determine their voltages; does every "
        "electrode see a given voltage through the body or its circuit?");
  if (coupling_.rows() == 0)  // which BLAS refuses
    return;
  if (parallel::is_first())
    stiffness_ = body_.stiffness() + coupling_ * admittance_.solve(MatrixXd(coupling_.transpose()));
}

template <int dim>
std::vector<double> ConnectedBody<dim>::product(const std::vector<double> &x) const {
  return model_.product(x, body_.is_refined());
}

template <int dim>
void ConnectedBody<dim>::refine() {
  body_.refine(model_.cells);
  if (circuit_.free().empty())
    return;
  response_.clear();
  reaction_.clear();
  add_responses();
  take_back();
}

template <int dim>
const MatrixXd &ConnectedBody<dim>::stiffness() const {
  return circuit_.free().empty() ? body_.stiffness() : stiffness_;
}

// Q0: the charges with all free electrodes at 0 V and the contact at rest.
template <int dim>
VectorXd ConnectedBody<dim>::charges_at_rest(std::span<const double> right_side,
                                             std::span<const double> state) const {
  VectorXd charges(static_cast<Index>(response_.size()));
  for (std::size_t e = 0; e < response_.size(); ++e) {
    double sum = dot(response_[e], right_side);
    for (const std::size_t i : lifted_)
      sum -= reaction_[e][i] * state[i];
    charges[static_cast<Index>(e)] = sum;
  }
  return charges;
}

template <int dim>
VectorXd ConnectedBody<dim>::reduce(double time, std::span<const double> right_side,
                                    std::span<const double> state) {
  VectorXd s = body_.reduce(right_side, state);
  if (circuit_.free().empty())
    return s;
  supplied_ = history_.supplied(circuit_, time, state);
  released_ = supplied_ - charges_at_rest(right_side, state);
  if (s.size() > 0)
    s += coupling_ * admittance_.solve(released_);
  return s;
}

template <int dim>
void ConnectedBody<dim>::expand(const VectorXd &c, std::span<double> state) {
  body_.expand(c, state);
  if (circuit_.free().empty())
    return;
  if (c.size() > 0)
    released_ -= coupling_.transpose() * c;
  const VectorXd v = admittance_.solve(released_);
  Eigen::Map<VectorXd> x(state.data(), static_cast<Index>(state.size()));
  for (std::size_t e = 0; e < response_.size(); ++e)
    x += v[static_cast<Index>(e)] *
         Eigen::Map<const VectorXd>(response_[e].data(), static_cast<Index>(state.size()));
  history_.end_step(circuit_, supplied_, state);
}

template <int dim>
void ConnectedBody<dim>::save(output::SavedNumbers &numbers) const {
  history_.save(numbers);
}

template <int dim>
void ConnectedBody<dim>::restore(const output::SavedNumbers &numbers) {
  history_.restore(numbers);
}

template class ConnectedBody<2>;
template class ConnectedBody<3>;

}  // namespace tourmaline::solve
