#include "solve/held_bounds.h"

#include <cmath>
#include <utility>

#include "larger.h"

namespace tourmaline::solve {

using contact::PointLaw;
using contact::Tresca;
using Eigen::Index;
using Eigen::VectorXd;

namespace {

std::vector<bool> closed_in(const std::vector<HeldBounds::State> &states) {
  std::vector<bool> is_closed;
  for (const HeldBounds::State &state : states)
    is_closed.push_back(state.is_closed);
  return is_closed;
}

}  // namespace

HeldBounds::HeldBounds(std::vector<std::shared_ptr<const contact::FrictionBound>> bounds,
                       const std::vector<State> &start)
    : bounds_(std::move(bounds)), held_(asked_for(start)), is_closed_(closed_in(start)) {}

VectorXd HeldBounds::asked_for(const std::vector<State> &states) const {
  VectorXd values = VectorXd::Zero(static_cast<Index>(states.size()));
  for (std::size_t i = 0; i < states.size(); ++i)
    if (states[i].is_closed && bounds_[i])
      values[static_cast<Index>(i)] = bounds_[i]->at(states[i].pressure, states[i].slip).bound;
  return values;
}

PointLaw HeldBounds::law(std::size_t node, const PointLaw &own) const {
  if (!bounds_[node] && is_closed_[node])
    return own;
  return {Tresca{held_[static_cast<Index>(node)]}, own.held()};
}

bool HeldBounds::settle(const std::vector<State> &found, double tolerance) {
  const VectorXd asked = asked_for(found);
  std::vector<bool> is_closed = closed_in(found);
  const double change = (asked - held_).lpNorm<Eigen::Infinity>();
  bool same =
      change <= tolerance || stall_.see(relative_to(change, asked.lpNorm<Eigen::Infinity>()));
  for (std::size_t i = 0; i < found.size(); ++i)
    if (!bounds_[i] && is_closed[i] != is_closed_[i])
      same = false;
  if (same)
    return true;
  is_closed_ = std::move(is_closed);
  held_ = anderson_.next(held_, asked).cwiseMax(0);
  return false;
}

}  // namespace tourmaline::solve
