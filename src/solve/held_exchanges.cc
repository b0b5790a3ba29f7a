#include "solve/held_exchanges.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "larger.h"
#include "tourmaline/error.h"

namespace tourmaline::solve {

using Eigen::Index;
using Eigen::VectorXd;

template <int dim>
HeldExchanges<dim>::HeldExchanges(const Model<dim> &model)
    : model_(model),
      nodes_(model),
      slope_(VectorXd::Zero(nodes_.size())),
      rest_(slope_),
      asked_slope_(slope_),
      asked_rest_(slope_) {}

// Of the first step nothing is known: contact that touches without pressure.
template <int dim>
void HeldExchanges<dim>::begin_step(double time, std::span<const double> state) {
  nodes_.begin_step(time, state);
  anderson_ = {};
  stall_ = {};
  rounds_ = 0;
  if (is_new_) {
    ask(state, [](std::size_t) { return contact::ContactState(); });
    slope_ = asked_slope_;
    rest_ = asked_rest_;
    is_new_ = false;
  }
  size_ = is_empty() ? 0 : larger(nodes_.entries(state).cwiseAbs().maxCoeff(), 1e-12);
}

template <int dim>
void HeldExchanges<dim>::add_rests(std::span<double> right_side) const {
  for (std::size_t k = 0; k < sites().size(); ++k)
    right_side[sites()[k].unknown] += rest_[static_cast<Index>(k)];
}

template <int dim>
void HeldExchanges<dim>::ask(std::span<const double> state, const StateAtNode &state_at) {
  for (std::size_t k = 0; k < sites().size(); ++k) {
    const auto row = nodes_.row(k, state[sites()[k].unknown], state_at(sites()[k].node));
    asked_slope_[static_cast<Index>(k)] = row.slope;
    asked_rest_[static_cast<Index>(k)] = row.rest;
  }
}

template <int dim>
double HeldExchanges<dim>::lack(std::span<const double> state) const {
  const std::vector<double> terms = model_.op.sizes(model_.step, state);
  std::array<double, 3> lacks{}, sizes{};
  for (std::size_t k = 0; k < sites().size(); ++k) {
    const auto entry = static_cast<Index>(k);
    const std::size_t unknown = sites()[k].unknown;
    const int field = body::field_of<dim>(unknown);
    const double asked = asked_slope_[entry] * state[unknown] + asked_rest_[entry],
                 held = slope_[entry] * state[unknown] + rest_[entry];
    lacks[field] = larger(lacks[field], std::abs(asked - held));
    sizes[field] = larger(sizes[field], larger(terms[unknown], std::abs(asked)));
  }
  return larger(relative_to(lacks[1], sizes[1]), relative_to(lacks[2], sizes[2]));
}

// In numbers of one size: rows by the entries' scale, slopes by what they do to an entry.
template <int dim>
void HeldExchanges<dim>::mix() {
  const VectorXd &scale = nodes_.scale();
  const VectorXd of_slope = size_ * scale.cwiseAbs2();
  VectorXd held(2 * slope_.size()), asked(held.size());
  held << of_slope.cwiseProduct(slope_), scale.cwiseProduct(rest_);
  asked << of_slope.cwiseProduct(asked_slope_), scale.cwiseProduct(asked_rest_);
  const VectorXd next = anderson_.next(held, asked);
  slope_ = next.head(slope_.size()).cwiseQuotient(of_slope).cwiseMax(0);
  rest_ = next.tail(slope_.size()).cwiseQuotient(scale);
}

template <int dim>
bool HeldExchanges<dim>::settle(double time, std::span<const double> state,
                                const StateAtNode &state_at, double tolerance) {
  constexpr int most = 200;
  ask(state, state_at);
  const double lacks = lack(state);
  if (lacks <= tolerance || stall_.see(lacks))
    return true;
  if (++rounds_ == most)
    throw UnsettledStep(fmt::format(
        "heat and charge that cross the contact by its state did not settle at t = {:g} s in {} "
        "rounds: {:.3g} of the flows is left, wanted {:.3g}; take smaller time steps, let "
        "conductances fade over a longer ramp, or take solver.method = \"condensed\" with "
        "solver.body = \"direct\"",
        time, most, lacks, tolerance));
  mix();
  return false;
}

template <int dim>
void HeldExchanges<dim>::end_step(std::span<const double> state, const StateAtNode &state_at,
                                  StepOutcome &outcome) {
  nodes_.prepare(outcome);
  nodes_.end_step(nodes_.scale().cwiseProduct(nodes_.entries(state)), state_at, outcome);
}

template <int dim>
void HeldExchanges<dim>::add_flows(const StepOutcome &outcome, std::span<double> right_side) const {
  const VectorXd rows = nodes_.rows(outcome);
  for (std::size_t k = 0; k < sites().size(); ++k)
    right_side[sites()[k].unknown] += rows[static_cast<Index>(k)];
}

template <int dim>
void HeldExchanges<dim>::save(output::SavedNumbers &numbers) const {
  nodes_.save(numbers);
  if (is_empty())
    return;
  numbers.put("held exchanges' slopes", slope_);
  numbers.put("held exchanges' rests", rest_);
}

template <int dim>
void HeldExchanges<dim>::restore(const output::SavedNumbers &numbers) {
  nodes_.restore(numbers);
  if (is_empty())
    return;
  numbers.fill("held exchanges' slopes", slope_);
  numbers.fill("held exchanges' rests", rest_);
  is_new_ = false;
}

template class HeldExchanges<2>;
template class HeldExchanges<3>;

}  // namespace tourmaline::solve
