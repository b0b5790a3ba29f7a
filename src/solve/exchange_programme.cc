#include "solve/exchange_programme.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "dense/decompositions.h"
#include "larger.h"
#include "solve/anderson.h"
#include "solve/damped_newton.h"

namespace tourmaline::solve {

using contact::ContactState;
using contact::Exchange;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Place = NaturalMap::Place;

namespace {

// The verdict is on the largest forces and flows: smaller ones get their digits by another step or
// two.
constexpr int steps_for_smaller_ones = 2;

const contact::PointLaw &friction_at(std::size_t slip, const std::vector<ContactPoint> &points,
                                     const CoupledSolution &solution,
                                     const std::vector<FrictionCoupling> &couplings) {
  for (std::size_t j = 0; j < couplings.size(); ++j)
    if (couplings[j].slip == slip)
      return solution.friction[j];
  return points[slip].law.friction();
}

/// Of all exchanges, q = slope x + rest, both as in rows of A [N/m, N].
struct Held {
  VectorXd slope, rest;
};

class Fixed {
 public:
  Fixed(const ExchangeProgramme &programme, const InterfaceSettings &settings,
        const SolveHeld &solve_held)
      : programme_(programme),
        settings_(settings),
        solve_held_(solve_held),
        n_(programme.whole.n_forces()),
        m_(programme.whole.force.size() - n_) {}

  CoupledSolution solve(const VectorXd &start, const CoupledContact *polished);

  int iterations() const { return count_.made; }

 private:
  Held held(const VectorXd &d, const CoupledSolution &solution) const;
  CoupledSolution with(const Held &held, const VectorXd &start);
  double lack(const CoupledSolution &solution) const;
  static VectorXd joined(const Held &held, double size);
  static Held parted(const VectorXd &all, double size);

  const ExchangeProgramme &programme_;
  const InterfaceSettings settings_;
  const SolveHeld &solve_held_;
  const Index n_, m_;  // entries of points, of exchanges
  IterationCount count_;
};

// By the law's slope at the value at hand: exact where the law is linear in it.
Held Fixed::held(const VectorXd &d, const CoupledSolution &solution) const {
  Held held{VectorXd(m_), VectorXd(m_)};
  for (const ExchangePoint &at : programme_.exchanges) {
    const ContactState state =
        state_at(at, programme_.whole.points, solution, programme_.couplings);
    const double value = at.of_value * d[at.entry];
    const Exchange::Value q = at.law->at(value, state);
    held.slope[at.entry - n_] = at.of_flow * q.by_value * at.of_value;
    held.rest[at.entry - n_] = at.of_flow * (q.flow - q.by_value * value);
  }
  return held;
}

// lambda_e + slope x + rest = 0 with lambda_e = f_e - B^T z + N x gives (N + slope) x = B^T z - f_e
// - rest, which goes into the rows of points.
CoupledSolution Fixed::with(const Held &held, const VectorXd &start) {
  const MatrixXd &a = programme_.whole.stiffness;
  const auto b = a.topRightCorner(n_, m_);
  MatrixXd inner = -a.bottomRightCorner(m_, m_);
  inner.diagonal() += held.slope;
  const dense::Cholesky factor(inner);
  CoupledSolution found;
  found.interface.increment = start;
  if (!factor.is_definite())
    return found;
  const VectorXd given = programme_.whole.force.tail(m_) + held.rest;
  MatrixXd stiffness = a.topLeftCorner(n_, n_) + b * factor.solve(MatrixXd(b.transpose()));
  stiffness = (stiffness + stiffness.transpose()).eval() / 2;
  const VectorXd lifted = b * factor.solve(given);
  const VectorXd force = programme_.whole.force.head(n_) + lifted;
  const InterfaceProgramme left{stiffness, force, programme_.whole.points,
                                larger(programme_.whole.force_scale, lifted.cwiseAbs().maxCoeff())};
  found = solve_held_(left, start.head(n_));
  count_.made += found.interface.iterations;
  VectorXd d(n_ + m_);
  d << found.interface.increment,
      factor.solve(VectorXd(b.transpose() * found.interface.increment - given));
  found.interface.increment = d;
  found.interface.force.conservativeResize(n_ + m_);
  return found;
}

// The largest of what the rows of exchanges lack, over the size of their field.
double Fixed::lack(const CoupledSolution &solution) const {
  const VectorXd &d = solution.interface.increment;
  const Held now = held(d, solution);
  VectorXd row = programme_.whole.force;
  subtract_product(programme_.whole.stiffness, d, row);
  double worst = 0;
  for (std::size_t f = 0; f < programme_.whole.fields.size(); ++f) {
    const FieldRows &rows = programme_.whole.fields[f];
    double lacks = 0, size = size_of_flows(programme_.whole, d, f);
    for (Index e = rows.begin; e < rows.begin + rows.size; ++e) {
      const double own = now.slope[e - n_] * d[e];
      lacks = larger(lacks, std::abs(row[e] + own + now.rest[e - n_]));
      size = larger(size, std::abs(own));
    }
    worst = larger(worst, relative_to(lacks, size));
  }
  return worst;
}

// In numbers of one size: slopes count by what they do to an entry of that size.
VectorXd Fixed::joined(const Held &held, double size) {
  VectorXd all(2 * held.slope.size());
  all << size * held.slope, held.rest;
  return all;
}

Held Fixed::parted(const VectorXd &all, double size) {
  const Index m = all.size() / 2;
  return {(all.head(m) / size).cwiseMax(0), all.tail(m)};
}

CoupledSolution Fixed::solve(const VectorXd &start, const CoupledContact *polished) {
  constexpr int most = 200, polishing = 12;
  count_.begin_attempt(std::max(most, settings_.max_iterations));
  Anderson anderson;
  CoupledSolution found;
  found.interface.increment = start;
  found.interface.force = VectorXd::Zero(start.size());
  for (const FrictionCoupling &coupling : programme_.couplings)
    found.friction.emplace_back(contact::Tresca{0},
                                programme_.whole.points[coupling.slip].law.friction().held());
  VectorXd x;
  double size = 0, least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < most; ++k) {
    const Held now = held(found.interface.increment, found);
    size = size > 0 ? size : larger(start.tail(m_).cwiseAbs().maxCoeff(), 1e-12);
    x = k == 0 ? joined(now, size) : anderson.next(x, joined(now, size));
    found = with(parted(x, size), found.interface.increment);
    if (!found.interface.converged)
      return found;
    const double lacks = lack(found);
    found.interface.residual = larger(found.interface.residual, lacks);
    if (lacks <= settings_.tolerance)
      return found;
    found.interface.converged = false;
    if (polished != nullptr && lacks < least / 2) {
      least = lacks;
      const NaturalMap map(*polished, 1);
      count_.begin_attempt(settings_.max_iterations);
      if (Place trial = map.at(found.interface.increment);
          damped_newton(map, trial, settings_.tolerance, polishing, count_)) {
        found = map.solution(trial);
        found.interface.converged = true;
        return found;
      }
    }
  }
  return found;
}

}  // namespace

ContactState state_at(const ExchangePoint &at, const std::vector<ContactPoint> &points,
                      const CoupledSolution &solution,
                      const std::vector<FrictionCoupling> &couplings) {
  const VectorXd &d = solution.interface.increment;
  ContactState state = at.known;
  if (at.normal) {
    const ContactPoint &n = points[*at.normal];
    state.pressure = solution.interface.force[n.offset] / n.weight;
    state.penetration += n.slip(d)[0];
  }
  const ContactPoint &p = points[at.slip];
  state.friction = friction_at(at.slip, points, solution, couplings).dissipation(p.slip(d));
  return state;
}

CoupledSolution solve_exchanging(const ExchangeProgramme &programme, const VectorXd &start,
                                 const InterfaceSettings &settings, const SolveHeld &solve_held,
                                 bool newton) {
  constexpr int most = 50;
  DenseBody body(programme.whole, settings.factor);
  const CoupledContact contact{body, programme.whole.points, programme.couplings,
                               programme.exchanges};
  IterationCount count;
  CoupledSolution found;
  const NaturalMap map(contact, 1);
  count.begin_attempt(settings.max_iterations);
  if (Place x = map.at(start); newton && damped_newton(map, x, settings.tolerance, most, count)) {
    polish(map, x, steps_for_smaller_ones, count);
    found = map.solution(x);
    found.interface.converged = true;
    found.interface.iterations = count.made;
  } else {
    Fixed fixed(programme, settings, solve_held);
    found = fixed.solve(start, newton ? &contact : nullptr);
    found.stage = ContactStage::fixed_point;
    found.interface.iterations = count.made + fixed.iterations();
  }
  found.slip_jumped = found.interface.converged && settings.is_definite &&
                      slip_sets_in_unstable(contact, start, found);
  return found;
}

}  // namespace tourmaline::solve
