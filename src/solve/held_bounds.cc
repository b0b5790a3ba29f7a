#include "solve/held_bounds.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "contact/shared_law.h"
#include "larger.h"

namespace tourmaline::solve {

namespace {

constexpr int undecided = 3;  // has opened or closed so often

}  // namespace

using contact::PointLaw;
using contact::Tangent;
using contact::Tresca;
using Eigen::Index;
using Eigen::VectorXd;

HeldBounds::HeldBounds(std::vector<std::shared_ptr<const contact::FrictionBound>> bounds,
                       std::vector<PointLaw> own, Index n_directions,
                       const std::vector<State> &start)
    : bounds_(std::move(bounds)),
      own_(std::move(own)),
      n_directions_(n_directions),
      held_(VectorXd::Zero(static_cast<Index>(start.size()))),
      whole_(held_),
      turns_(start.size(), 0) {
  for (std::size_t i = 0; i < start.size(); ++i) {
    const auto row = static_cast<Index>(i);
    is_closed_.push_back(start[i].is_closed);
    whole_[row] = whole_bound(i, start[i]);
    held_[row] = asked_for(i, start[i]);
  }
}

// What a closed node has; of a law of its own, whose tractions may be another set than a ball, what
// resists the slip along the first direction.
double HeldBounds::whole_bound(std::size_t node, const State &found) const {
  if (bounds_[node])
    return bounds_[node]->at(found.pressure, found.slip).bound;
  return PointLaw(own_[node].law()).dissipation(Tangent::Unit(n_directions_, 0));
}

// Of a node that opens and closes in turn, its pressure or opening says whether it wants more or
// less than it has.
double HeldBounds::asked_for(std::size_t node, const State &found) const {
  const auto row = static_cast<Index>(node);
  if (turns_[node] < undecided)
    return found.is_closed ? whole_[row] : 0;
  if (!found.is_closed)  // a bound that falls to nothing with the pressure leaves no share
    return std::clamp(std::min(held_[row], found.friction) - found.opening, 0., whole_[row]);
  const bool sticks = found.slip == 0;  // and would with more
  return sticks ? whole_[row] : std::clamp(held_[row] + found.pressure, 0., whole_[row]);
}

PointLaw HeldBounds::law(std::size_t node) const {
  const PointLaw &own = own_[node];
  const auto row = static_cast<Index>(node);
  if (bounds_[node] || held_[row] == 0)
    return {Tresca{held_[row]}, own.held()};
  if (held_[row] == whole_[row])
    return own;
  return {contact::shared(own.law(), held_[row] / whole_[row]), own.held()};
}

bool HeldBounds::is_undecided() const {
  return std::any_of(turns_.begin(), turns_.end(), [](int turns) { return turns >= undecided; });
}

bool HeldBounds::just_touches(std::size_t node) const {
  constexpr double nothing = 1e-9;
  const auto row = static_cast<Index>(node);
  return turns_[node] >= undecided && held_[row] > nothing * whole_[row] &&
         held_[row] < whole_[row];
}

// Where many nodes just touch and answer to one another, mixing may go round for ever. Calm steps
// then come near, from where it settles.
VectorXd HeldBounds::mixed(const VectorXd &asked) {
  constexpr int quick = 20, calm = 30;
  const int phase = rounds_++ % (quick + calm);
  if (phase == 0)
    anderson_ = {};
  if (phase == quick)
    calm_ = {};
  return phase < quick ? anderson_.next(held_, asked) : calm_.next(held_, asked);
}

bool HeldBounds::settle(const std::vector<State> &found, double tolerance) {
  VectorXd asked(held_.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    const auto row = static_cast<Index>(i);
    turns_[i] += found[i].is_closed != is_closed_[i];
    is_closed_[i] = found[i].is_closed;
    whole_[row] = whole_bound(i, found[i]);
    asked[row] = asked_for(i, found[i]);
  }
  const double change = (asked - held_).lpNorm<Eigen::Infinity>();
  if (change <= tolerance || stall_.see(relative_to(change, asked.lpNorm<Eigen::Infinity>())))
    return true;
  held_ = mixed(asked).cwiseMax(0);
  for (std::size_t i = 0; i < found.size(); ++i) {
    const auto row = static_cast<Index>(i);
    held_[row] = bounds_[i] ? held_[row] : std::min(held_[row], whole_[row]);
    if (!bounds_[i] && turns_[i] < undecided)
      held_[row] = asked[row];
  }
  return false;
}

}  // namespace tourmaline::solve
