#include "solve/coupled_programme.h"

#include <algorithm>
#include <deque>
#include <limits>

#include "solve/natural_map.h"

namespace tourmaline::solve {

using contact::PointLaw;
using contact::Tresca;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Place = NaturalMap::Place;

namespace {

/// Mixes the last iterates of a fixed point so that what they changed by cancels best. (D. G.
/// Anderson, J. ACM 12 (1965) 547-560.)
class Anderson {
 public:
  VectorXd next(const VectorXd &x, const VectorXd &image) {
    constexpr std::size_t depth = 5;
    x_.push_back(image);
    change_.push_back(image - x);
    if (x_.size() > depth + 1) {
      x_.pop_front();
      change_.pop_front();
    }
    const auto m = static_cast<Index>(x_.size()) - 1;
    if (m == 0)
      return image;
    MatrixXd changes(x.size(), m), images(x.size(), m);
    for (Index k = 0; k < m; ++k) {
      const auto at = static_cast<std::size_t>(k);
      changes.col(k) = change_[at + 1] - change_[at];
      images.col(k) = x_[at + 1] - x_[at];
    }
    return image - images * changes.completeOrthogonalDecomposition().solve(change_.back());
  }

 private:
  std::deque<VectorXd> x_, change_;
};

class Cascade {
 public:
  Cascade(const CoupledProgramme &programme, const InterfaceSettings &settings)
      : programme_(programme), settings_(settings) {}

  CoupledSolution solve(const VectorXd &start);

 private:
  bool newton(const NaturalMap &map, Place &x, int most);
  bool find_by_newton(const VectorXd &start, Place &x);
  VectorXd without_contact() const;
  bool fixed_point(double strength, Place &x);
  bool continuation(Place &x);
  InterfaceSolution convex(const std::vector<PointLaw> &friction, const VectorXd &start);
  bool is_left() const { return iterations_ < settings_.max_iterations; }

  const CoupledProgramme &programme_;
  const InterfaceSettings settings_;
  int iterations_ = 0;  // linear systems
};

// Damped by halving, with the lengths at which points change their branch as candidates.
bool Cascade::newton(const NaturalMap &map, Place &x, int most) {
  constexpr double armijo = 1e-4;
  for (int k = 0; map.residual(x) > settings_.tolerance; ++k) {
    if (k == most || !is_left())
      return false;
    const VectorXd direction = map.newton_direction(x);
    ++iterations_;
    if (direction.size() == 0)
      return false;
    const VectorXd resisted = programme_.convex.stiffness * direction;
    const auto along = [&](double t) { return Place{x.d + t * direction, x.force - t * resisted}; };
    const double merit = map.merit(x);
    double best = 1, least = map.merit(along(1));
    if (!(least <= (1 - 2 * armijo) * merit)) {
      std::vector<double> lengths = map.turns(x, direction, resisted);
      for (double t = 0.5; t > 1e-4; t /= 2)
        lengths.push_back(t);
      for (const double t : lengths)
        if (const double value = map.merit(along(t)); value < least) {
          least = value;
          best = t;
        }
      if (!(least <= (1 - 2 * armijo * best) * merit))
        return false;
    }
    x = map.at(x.d + best * direction);
  }
  x = map.settled(x);
  return map.residual(x) <= settings_.tolerance;
}

VectorXd Cascade::without_contact() const {
  VectorXd d = VectorXd::Zero(programme_.convex.force.size());
  const Eigen::LLT<MatrixXd> factor(programme_.convex.stiffness);
  if (factor.info() == Eigen::Success)
    d = factor.solve(programme_.convex.force);
  return d;
}

bool Cascade::find_by_newton(const VectorXd &start, Place &x) {
  constexpr int most = 50;
  const NaturalMap map(programme_, 1);
  x = map.at(start);
  if (newton(map, x, most))
    return true;
  x = map.at(without_contact());
  return settings_.is_definite && newton(map, x, most);
}

InterfaceSolution Cascade::convex(const std::vector<PointLaw> &friction, const VectorXd &start) {
  std::vector<ContactPoint> points = programme_.convex.points;
  for (std::size_t j = 0; j < friction.size(); ++j)
    points[programme_.couplings[j].slip].law = friction[j];
  const InterfaceProgramme held{programme_.convex.stiffness, programme_.convex.force, points,
                                programme_.convex.force_scale};
  InterfaceSolution found =
      minimise(held, start,
               {settings_.tolerance, std::max(1, settings_.max_iterations - iterations_),
                settings_.is_definite});
  iterations_ += found.iterations;
  return found;
}

// The bounds of the convex programme's solution are those of the next one. Where it has come near,
// Newton's method ends it.
bool Cascade::fixed_point(double strength, Place &x) {
  constexpr int most = 100, polishing = 12;
  const NaturalMap map(programme_, strength);
  const auto n = static_cast<Index>(programme_.couplings.size());
  const auto bounds_at = [&](const Place &place) {
    VectorXd bounds = VectorXd::Zero(n);
    const std::vector<PointLaw> laws = map.friction_at(place);
    for (Index j = 0; j < n; ++j)
      if (const auto *ball = std::get_if<Tresca>(&laws[static_cast<std::size_t>(j)].law()))
        bounds[j] = ball->bound;
    return bounds;
  };
  Anderson anderson;
  VectorXd bounds = bounds_at(x);
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < most && is_left(); ++k) {
    std::vector<PointLaw> laws = map.friction_at(x);
    for (std::size_t j = 0; j < laws.size(); ++j)
      if (programme_.couplings[j].bound)
        laws[j] = {Tresca{bounds[static_cast<Index>(j)]}, laws[j].held()};
    const InterfaceSolution found = convex(laws, x.d);
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
    bounds = anderson.next(bounds, bounds_at(x)).cwiseMax(0);
  }
  return false;
}

// From no friction to all of it, by steps that are halved where they are too long.
bool Cascade::continuation(Place &x) {
  constexpr double shortest = 1. / 256;
  double strength = 0, step = 0.25;
  x = NaturalMap(programme_, 0).at(VectorXd::Zero(programme_.convex.force.size()));
  if (!fixed_point(0, x))
    return false;
  while (strength < 1 && is_left()) {
    const double next = std::min(1., strength + step);
    Place trial = x;
    const NaturalMap map(programme_, next);
    trial = map.at(trial.d);
    if (newton(map, trial, 25) || (trial = x, fixed_point(next, trial))) {
      strength = next;
      x = trial;
      step *= 2;
    } else if ((step /= 2) < shortest) {
      return false;
    }
  }
  return strength == 1;
}

CoupledSolution Cascade::solve(const VectorXd &start) {
  Place x;
  ContactStage stage = ContactStage::newton;
  bool converged = find_by_newton(start, x);
  if (!converged) {
    stage = ContactStage::fixed_point;
    x = NaturalMap(programme_, 1).at(start);
    converged = fixed_point(1, x);
  }
  if (!converged) {
    stage = ContactStage::continuation;
    converged = continuation(x);
  }
  const NaturalMap map(programme_, 1);
  x = map.at(x.d);
  CoupledSolution found = map.solution(x);
  found.stage = stage;
  found.interface.iterations = iterations_;
  found.interface.converged = converged;
  if (!converged)
    found.interface.unsettled = map.unsettled(x, settings_.tolerance);
  return found;
}

}  // namespace

CoupledSolution solve_coupled(const CoupledProgramme &programme, const VectorXd &start,
                              const InterfaceSettings &settings) {
  return Cascade(programme, settings).solve(start);
}

}  // namespace tourmaline::solve
