#include "solve/coupled_programme.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>

#include "dense/decompositions.h"
#include "solve/anderson.h"
#include "solve/damped_newton.h"
#include "solve/natural_map.h"
#include "solve/spring_path.h"

namespace tourmaline::solve {

using contact::PointLaw;
using contact::Tresca;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Place = NaturalMap::Place;

namespace {

// At points that are free until they touch.
bool may_open(const std::vector<ContactPoint> &points) {
  return std::any_of(points.begin(), points.end(), [](const ContactPoint &p) {
    return p.law.normal() != nullptr && p.law.has_kink(p.size);
  });
}

class Cascade {
 public:
  Cascade(const CoupledContact &contact, const InterfaceSettings &settings)
      : programme_(contact), settings_(settings) {}

  CoupledSolution solve(const VectorXd &start);

 private:
  bool newton(const NaturalMap &map, Place &x, int most = std::numeric_limits<int>::max());
  bool find_by_newton(const VectorXd &start, Place &x);
  bool find_by_springs(Place &x);
  bool fixed_point(const NaturalMap &map, Place &x);
  bool filled(Place &x);
  bool filled_from_any(const VectorXd &start, Place &x);
  bool continuation(Index n_entries, Place &x);
  CoupledSolution solve_convex(const VectorXd &start);
  InterfaceSolution convex(const std::vector<PointLaw> &friction, const VectorXd &start,
                           int patience = 0);
  // Every attempt may take as many iterations as are asked for; of many points, whose states change
  // one after the other along the edges of contact and slip, in proportion more.
  void begin_attempt(int programmes = 1) {
    const auto thousands = static_cast<int>(programme_.points.size() / 1000);
    count_.begin_attempt(std::min(settings_.max_iterations * programmes * std::max(1, thousands),
                                  settings_.in_all - count_.made));
  }

  const CoupledContact programme_;
  const InterfaceSettings settings_;
  IterationCount count_;
};

bool Cascade::newton(const NaturalMap &map, Place &x, int most) {
  return damped_newton(map, x, settings_.tolerance, most, count_);
}

bool Cascade::find_by_newton(const VectorXd &start, Place &x) {
  const NaturalMap map(programme_, 1);
  begin_attempt();
  x = map.at(start);
  if (newton(map, x))
    return true;
  if (!settings_.is_definite)
    return false;
  if (may_open(programme_.points))
    return find_by_springs(x);
  begin_attempt();
  x = map.at(programme_.body.without_contact());
  return newton(map, x);
}

bool Cascade::find_by_springs(Place &x) {
  constexpr int most = 30;
  std::vector<ContactPoint> sprung = programme_.points;
  const CoupledContact contact{programme_.body, sprung, programme_.couplings};
  x.d = programme_.body.without_contact();
  const bool is_near = follow_springs([&](double stiffness) {
    for (std::size_t i = 0; i < sprung.size(); ++i)
      sprung[i].law = programme_.points[i].law.behind_spring(
          stiffness * programme_.body.curvature(i) / sprung[i].weight);
    begin_attempt();
    const NaturalMap map(contact, 1);
    Place trial = map.at(x.d);
    const bool is_solved = newton(map, trial, most);
    if (is_solved)
      x = trial;
    return is_solved;
  });
  begin_attempt();
  const NaturalMap map(programme_, 1);
  x = map.at(x.d);
  return is_near && newton(map, x);
}

InterfaceSolution Cascade::convex(const std::vector<PointLaw> &friction, const VectorXd &start,
                                  int patience) {
  std::vector<ContactPoint> with_friction;
  if (!friction.empty())
    with_friction = programme_.points;
  for (std::size_t j = 0; j < friction.size(); ++j)
    with_friction[programme_.couplings[j].slip].law = friction[j];
  const std::vector<ContactPoint> &points = friction.empty() ? programme_.points : with_friction;
  InterfaceSettings left = settings_;
  left.max_iterations = std::max(1, count_.last - count_.made);
  left.patience = patience;
  InterfaceSolution found = programme_.body.minimise(points, start, left);
  count_.made += found.iterations;
  return found;
}

// The bounds of the convex programme's solution are those of the next one. Where it has come near,
// Newton's method ends it.
bool Cascade::fixed_point(const NaturalMap &map, Place &x) {
  constexpr int most = 100, polishing = 12, at_length = 5;
  begin_attempt(at_length);
  Anderson anderson;
  VectorXd bounds = map.bounds(x);
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < most && count_.is_left(); ++k) {
    const InterfaceSolution found = convex(map.friction_at(x, bounds), x.d);
    x = map.at(found.increment);
    const double residual = map.residual(x);
    if (residual <= settings_.tolerance)
      return true;
    if (residual < least / 2) {
      least = residual;
      if (Place trial = x; newton(map, trial, polishing)) {
        x = trial;
        return true;
      }
    }
    bounds = anderson.next(bounds, map.bounds(x)).cwiseMax(0);
  }
  return false;
}

// Ramps in the place of the jumps, ever steeper ones; from each of them Newton's method may find
// which points have a share between 0 and 1.
bool Cascade::filled(Place &x) {
  constexpr int most = 30, polishing = 12;
  constexpr double steepest = 1e-9;
  const NaturalMap whole(programme_, 1, 0);
  if (!whole.has_jumps())
    return false;
  const double largest = programme_.body.largest_force();
  x = NaturalMap(programme_, 1, largest).at(x.d);
  double ramp = 1, factor = 0.1;
  while (ramp > steepest) {
    begin_attempt();
    const NaturalMap map(programme_, 1, ramp * largest);
    Place trial = x;
    if (newton(map, trial, most) || (trial = map.at(x.d), fixed_point(map, trial))) {
      x = trial;
      if (newton(whole, trial, polishing)) {
        x = trial;
        return true;
      }
      factor = std::max(factor * factor, 0.1);
    } else if ((factor = std::sqrt(factor)) > 0.9) {
      return false;
    } else {
      ramp /= factor;
    }
    ramp *= factor;
  }
  return false;
}

// The relation of shares is not monotone, so the way of the ramps may end; it is another one from
// another start.
bool Cascade::filled_from_any(const VectorXd &start, Place &x) {
  const NaturalMap none(programme_, 0), all(programme_, 1);
  const VectorXd rest = VectorXd::Zero(start.size());
  const auto n = static_cast<Index>(programme_.couplings.size());
  const auto with_bounds = [&](const NaturalMap &map, const VectorXd &bounds) {
    begin_attempt();
    return convex(map.friction_at(all.at(rest), bounds), start).increment;
  };
  const std::vector<std::function<VectorXd()>> starts{
      [&] { return start; }, [&] { return with_bounds(none, VectorXd::Zero(n)); },
      [&] { return with_bounds(all, all.bounds(all.at(rest))); },
      [&] { return programme_.body.without_contact(); }, [&] { return VectorXd(rest); }};
  return all.has_jumps() && std::any_of(starts.begin(), starts.end(), [&](const auto &make) {
           x = all.at(make());
           return filled(x);
         });
}

// From no friction to all of it, by steps that are halved where they are too long.
bool Cascade::continuation(Index n_entries, Place &x) {
  constexpr double shortest = 1. / 256;
  double strength = 0, step = 0.25;
  const NaturalMap none(programme_, 0, 0);
  x = none.at(VectorXd::Zero(n_entries));
  if (!fixed_point(none, x))
    return false;
  while (strength < 1) {
    begin_attempt();
    const double next = std::min(1., strength + step);
    Place trial = x;
    const NaturalMap map(programme_, next, 0);
    trial = map.at(trial.d, trial.share);
    if (newton(map, trial, 25) || (trial = x, fixed_point(map, trial))) {
      strength = next;
      x = trial;
      step *= 2;
    } else if ((step /= 2) < shortest) {
      return false;
    }
  }
  return strength == 1;
}

// Where the body begins to touch a foundation that yields, the programme's value may tell too
// little of the way to its minimum, and a slender body comes near it by ever smaller steps; the
// natural map's zero is the same place.
CoupledSolution Cascade::solve_convex(const VectorXd &start) {
  constexpr int patience = 10;
  CoupledSolution found;
  begin_attempt();
  found.interface = convex({}, start, patience);
  found.stage = ContactStage::convex;
  const auto is_stuck = [&] {
    return !found.interface.converged && found.interface.is_definite &&
           (count_.is_left() || may_yield(programme_.points));
  };
  const auto find = [&](Place &x) {
    return may_open(programme_.points) ? find_by_springs(x)
                                       : find_by_newton(found.interface.increment, x);
  };
  if (Place x; is_stuck() && find(x)) {
    found = NaturalMap(programme_, 1).solution(x);
    found.interface.converged = true;
  } else if (is_stuck()) {
    begin_attempt();
    found.interface = convex({}, found.interface.increment);
  }
  found.interface.iterations = count_.made;
  return found;
}

CoupledSolution Cascade::solve(const VectorXd &start) {
  if (programme_.couplings.empty())
    return solve_convex(start);
  const NaturalMap strict(programme_, 1), with_shares(programme_, 1, 0);
  const NaturalMap *map = &strict;
  Place x;
  ContactStage stage = ContactStage::newton;
  bool converged = find_by_newton(start, x);
  if (!converged) {
    if (filled_from_any(start, x)) {
      converged = true;
      map = &with_shares;
    }
  }
  if (!converged) {
    stage = ContactStage::fixed_point;
    x = strict.at(start);
    converged = fixed_point(strict, x);
  }
  if (!converged) {
    stage = ContactStage::continuation;
    converged = continuation(start.size(), x);
    map = &with_shares;
  }
  x = map->at(x.d, x.share);
  CoupledSolution found = map->solution(x);
  found.stage = stage;
  found.interface.iterations = count_.made;
  found.interface.converged = converged;
  found.slip_jumped =
      converged && settings_.is_definite && slip_sets_in_unstable(programme_, start, found);
  if (!converged)
    found.interface.unsettled = map->unsettled(x, settings_.tolerance);
  return found;
}

}  // namespace

bool slip_sets_in_unstable(const CoupledContact &contact, const VectorXd &start,
                           const CoupledSolution &found) {
  std::vector<Index> entries;
  std::vector<std::pair<Index, MatrixXd>> falls;  // from that row and column on
  for (std::size_t j = 0; j < contact.couplings.size(); ++j) {
    const FrictionCoupling &coupling = contact.couplings[j];
    const ContactPoint &p = contact.points[coupling.slip];
    const VectorXd slip = p.slip(found.interface.increment);
    if (!coupling.bound || slip.isZero(0))
      continue;
    const double fall = coupling.bound->at(found.pressure[j], p.slip(start).norm()).by_slip;
    if (fall < 0)
      falls.emplace_back(static_cast<Index>(entries.size()),
                         p.weight * fall * slip * slip.transpose() / slip.squaredNorm());
    for (Index c = 0; c < p.size; ++c)
      entries.push_back(p.offset + c);
  }
  if (falls.empty() || is_large(static_cast<Index>(entries.size())))
    return false;
  std::optional<MatrixXd> stiffness = contact.body.stiffness(entries);
  if (!stiffness)
    return false;
  for (const auto &[row, fall] : falls)
    stiffness->block(row, row, fall.rows(), fall.cols()) += fall;
  return !dense::Cholesky(*stiffness).is_definite();
}

CoupledSolution solve_coupled(const CoupledProgramme &programme, const VectorXd &start,
                              const InterfaceSettings &settings) {
  DenseBody body(programme.convex, settings.factor);
  return solve_coupled({body, programme.convex.points, programme.couplings}, start, settings);
}

CoupledSolution solve_coupled(const CoupledContact &contact, const VectorXd &start,
                              const InterfaceSettings &settings) {
  return Cascade(contact, settings).solve(start);
}

}  // namespace tourmaline::solve
