#include "solve/natural_map.h"

#include <algorithm>
#include <cmath>

#include "larger.h"

namespace tourmaline::solve {

using contact::FrictionBound;
using contact::LocalLaw;
using contact::PointLaw;
using contact::Tangent;
using contact::TangentMatrix;
using contact::Tresca;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

double largest_eigenvalue(const MatrixXd &stiffness, const ContactPoint &p) {
  const TangentMatrix block = stiffness.block(p.offset, p.offset, p.size, p.size);
  if (p.size == 1)
    return block(0, 0);
  return p.size == 0
             ? 0
             : Eigen::SelfAdjointEigenSolver<TangentMatrix>(block).eigenvalues()(p.size - 1);
}

}  // namespace

NaturalMap::NaturalMap(const CoupledProgramme &programme, double strength)
    : convex_(programme.convex), couplings_(programme.couplings), strength_(strength) {
  coupling_of_.assign(convex_.points.size(), -1);
  for (std::size_t j = 0; j < couplings_.size(); ++j)
    coupling_of_[couplings_[j].slip] = static_cast<int>(j);
  for (const ContactPoint &p : convex_.points)
    curvature_.push_back(largest_eigenvalue(convex_.stiffness, p));
}

NaturalMap::Place NaturalMap::at(VectorXd d) const {
  Place x{std::move(d), {}};
  x.force = convex_.force - convex_.stiffness * x.d;
  return x;
}

Tangent NaturalMap::trial(std::size_t i, const Place &x) const {
  const ContactPoint &p = point(i);
  return (x.force.segment(p.offset, p.size) + curvature_[i] * x.d.segment(p.offset, p.size)) /
         p.weight;
}

NaturalMap::Pressure NaturalMap::pressure(const FrictionCoupling &coupling, const Place &x) const {
  if (!coupling.normal)
    return {coupling.pressure, coupling.is_closed};
  const std::size_t n = *coupling.normal;
  const contact::NormalLaw &law = *point(n).law.normal();
  const double y = trial(n, x)[0];
  return {law.pressure(y, curvature_[n] / point(n).weight), law.is_closed(y)};
}

double NaturalMap::slip_size(std::size_t i, const Place &x) const {
  const ContactPoint &p = point(i);
  return std::hypot(x.d.segment(p.offset, p.size).norm(), p.law.held().norm());
}

FrictionBound::Value NaturalMap::bound(const FrictionCoupling &coupling, const Place &x) const {
  const Pressure p = pressure(coupling, x);
  if (!p.is_closed || !coupling.bound)
    return {};
  FrictionBound::Value value = coupling.bound->at(p.value, slip_size(coupling.slip, x));
  value.bound *= strength_;
  value.by_pressure *= strength_;
  value.by_slip *= strength_;
  return value;
}

PointLaw NaturalMap::friction(const FrictionCoupling &coupling, const Place &x) const {
  const PointLaw &own = point(coupling.slip).law.friction();
  if (!coupling.bound && pressure(coupling, x).is_closed)
    return own;
  return {Tresca{bound(coupling, x).bound}, own.held()};
}

LocalLaw NaturalMap::law(std::size_t i, const Place &x) const {
  const int j = coupling_of_[i];
  return j < 0 ? point(i).law : LocalLaw(friction(couplings_[static_cast<std::size_t>(j)], x));
}

Tangent NaturalMap::point_value(std::size_t i, const Place &x) const {
  const ContactPoint &p = point(i);
  return x.force.segment(p.offset, p.size) -
         p.weight * law(i, x).traction(trial(i, x), curvature_[i] / p.weight);
}

VectorXd NaturalMap::value(const Place &x) const {
  VectorXd all(x.d.size());
  for (std::size_t i = 0; i < convex_.points.size(); ++i)
    all.segment(point(i).offset, point(i).size) = point_value(i, x);
  return all;
}

double NaturalMap::merit(const Place &x) const {
  double sum = 0;
  for (std::size_t i = 0; i < convex_.points.size(); ++i)
    if (point(i).size > 0)
      sum += point_value(i, x).squaredNorm() / (curvature_[i] * curvature_[i]);
  return sum;
}

double NaturalMap::residual(const Place &x) const {
  double largest = 0;
  for (std::size_t i = 0; i < convex_.points.size(); ++i)
    largest = larger(largest, point_value(i, x).norm());
  return relative_to(largest, size_of_forces(convex_, x.d));
}

std::vector<std::size_t> NaturalMap::unsettled(const Place &x, double tolerance) const {
  const double allowed = tolerance * size_of_forces(convex_, x.d);
  std::vector<std::size_t> points;
  for (std::size_t i = 0; i < convex_.points.size(); ++i)
    if (!(point_value(i, x).norm() <= allowed))
      points.push_back(i);
  return points;
}

// The ball's traction grows with its radius along itself; with known components of the slip its
// difference quotient says how.
Tangent NaturalMap::by_bound(std::size_t i, const Branch &branch, const Place &x) const {
  const PointLaw law = this->law(i, x).friction();
  const double r = curvature_[i] / point(i).weight;
  const double b = branch.bound.bound, more = b == 0 ? 1 : b * (1 + 1e-6);
  const PointLaw larger_law{Tresca{more}, law.held()};
  return (larger_law.traction(branch.trial, r) - law.traction(branch.trial, r)) / (more - b);
}

NaturalMap::Branch NaturalMap::branch(std::size_t i, const Place &x) const {
  const ContactPoint &p = point(i);
  const LocalLaw law = this->law(i, x);
  Branch found;
  found.trial = trial(i, x);
  found.derivative = law.traction_derivative(found.trial, curvature_[i] / p.weight);
  found.by_bound = Tangent::Zero(p.size);
  if (const int j = coupling_of_[i]; j >= 0) {
    found.bound = bound(couplings_[static_cast<std::size_t>(j)], x);
    if (!found.derivative.isIdentity(0) &&
        (found.bound.by_pressure != 0 || found.bound.by_slip != 0))
      found.by_bound = by_bound(i, found, x);
  }
  found.is_held = p.size > 0 && found.derivative.isIdentity(0);
  return found;
}

// Rows of F' = (I - D) lambda' - D c - w T_b b', lambda' = -A, for the points that are not held.
VectorXd NaturalMap::newton_direction(const Place &x) const {
  const MatrixXd &stiffness = convex_.stiffness;
  std::vector<Branch> branches;
  std::vector<Index> entries;
  VectorXd direction = VectorXd::Zero(x.d.size());
  for (std::size_t i = 0; i < convex_.points.size(); ++i) {
    const ContactPoint &p = point(i);
    branches.push_back(branch(i, x));
    for (Index c = 0; c < p.size; ++c)
      if (branches.back().is_held)
        direction[p.offset + c] = -x.d[p.offset + c];
      else
        entries.push_back(p.offset + c);
  }
  const VectorXd resisted =
      direction.isZero(0) ? VectorXd(VectorXd::Zero(x.d.size())) : VectorXd(stiffness * direction);
  const auto n = static_cast<Index>(entries.size());
  MatrixXd jacobian(n, n);
  VectorXd right_side(n);
  Index row = 0;
  for (std::size_t i = 0; i < convex_.points.size(); ++i) {
    const ContactPoint &p = point(i);
    if (branches[i].is_held || p.size == 0)
      continue;
    const Branch &at = branches[i];
    const TangentMatrix free = TangentMatrix::Identity(p.size, p.size) - at.derivative;
    const MatrixXd rows = stiffness.middleRows(p.offset, p.size)(Eigen::all, entries);
    jacobian.middleRows(row, p.size) = -free * rows;
    TangentMatrix own = -curvature_[i] * at.derivative;
    right_side.segment(row, p.size) =
        -point_value(i, x) + free * resisted.segment(p.offset, p.size);
    if (at.bound.by_slip != 0) {
      const Tangent d = x.d.segment(p.offset, p.size);
      if (const double size = slip_size(i, x); size > 0)
        own -= p.weight * at.bound.by_slip / size * at.by_bound * d.transpose();
    }
    jacobian.block(row, row, p.size, p.size) += own;
    if (const int j = coupling_of_[i];
        j >= 0 && at.bound.by_pressure != 0 && couplings_[static_cast<std::size_t>(j)].normal) {
      // w dp = D_n (lambda_n' + c_n dd_n)
      const std::size_t k = *couplings_[static_cast<std::size_t>(j)].normal;
      const ContactPoint &normal = point(k);
      const Tangent by_force = p.weight / normal.weight * at.bound.by_pressure *
                               branches[k].derivative(0, 0) * at.by_bound;
      jacobian.middleRows(row, p.size) += by_force * stiffness.row(normal.offset)(entries).matrix();
      const double known = -resisted[normal.offset] + curvature_[k] * direction[normal.offset];
      right_side.segment(row, p.size) += by_force * known;
      if (const auto found = std::lower_bound(entries.begin(), entries.end(), normal.offset);
          found != entries.end() && *found == normal.offset)
        jacobian.block(row, found - entries.begin(), p.size, 1) -= by_force * curvature_[k];
    }
    row += p.size;
  }
  if (n == 0)
    return direction;
  const Eigen::PartialPivLU<MatrixXd> factor(jacobian);
  const VectorXd solved = factor.solve(right_side);
  if (!solved.allFinite())
    return {};
  direction(entries) = solved;
  return direction;
}

// What a point's trial value exceeds its border by; it changes its branch where this changes its
// sign.
double NaturalMap::excess(std::size_t i, const Place &x) const {
  const ContactPoint &p = point(i);
  const Tangent y = trial(i, x);
  if (p.law.normal() != nullptr)
    return y[0];
  const double r = curvature_[i] / p.weight;
  return (y - law(i, x).traction(y, r)).norm() - 1e-14 * y.norm();
}

std::vector<double> NaturalMap::turns(const Place &x, const VectorXd &direction,
                                      const VectorXd &resisted) const {
  constexpr int bisections = 20;
  const auto along = [&](double t) { return Place{x.d + t * direction, x.force - t * resisted}; };
  const Place whole = along(1);
  std::vector<double> lengths;
  for (std::size_t i = 0; i < convex_.points.size(); ++i) {
    if (point(i).size == 0 || (excess(i, x) > 0) == (excess(i, whole) > 0))
      continue;
    const bool start = excess(i, x) > 0;
    double low = 0, high = 1;
    for (int k = 0; k < bisections; ++k) {
      const double middle = (low + high) / 2;
      (((excess(i, along(middle)) > 0) == start) ? low : high) = middle;
    }
    lengths.push_back(high);
  }
  return lengths;
}

NaturalMap::Place NaturalMap::settled(const Place &x) const {
  Place exact = x;
  for (std::size_t i = 0; i < convex_.points.size(); ++i)
    if (branch(i, x).is_held)
      exact.d.segment(point(i).offset, point(i).size).setZero();
  return exact.d == x.d ? x : at(exact.d);
}

std::vector<PointLaw> NaturalMap::friction_at(const Place &x) const {
  std::vector<PointLaw> laws;
  for (const FrictionCoupling &coupling : couplings_)
    laws.push_back(friction(coupling, x));
  return laws;
}

CoupledSolution NaturalMap::solution(const Place &x) const {
  CoupledSolution found;
  found.interface.increment = x.d;
  found.interface.force = VectorXd::Zero(x.d.size());
  for (std::size_t i = 0; i < convex_.points.size(); ++i) {
    const ContactPoint &p = point(i);
    const double r = curvature_[i] / p.weight;
    const LocalLaw law = this->law(i, x);
    found.interface.force.segment(p.offset, p.size) = p.weight * law.traction(trial(i, x), r);
    found.interface.status.push_back(
        p.size == 0 && law.normal() != nullptr ? ContactStatus::stick : law.status(trial(i, x), r));
  }
  found.interface.residual = residual(x);
  found.friction = friction_at(x);
  for (const FrictionCoupling &coupling : couplings_)
    found.pressure.push_back(pressure(coupling, x).value);
  return found;
}

}  // namespace tourmaline::solve
