#pragma once

#include <cmath>
#include <random>

#include "solve/interface_newton.h"

namespace tourmaline::solve {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// A programme of the contact with the matrix at hand.
struct Problem {
  MatrixXd stiffness;
  VectorXd force;
  std::vector<ContactPoint> points;
  std::vector<double> bounds;  // w_i S_i [N]

  InterfaceSolution solve(const VectorXd &start, InterfaceSettings settings = {}) const {
    return minimise({stiffness, force, points}, start, settings);
  }
};

// What a point's slip z and force f lack of f = b (z, o) / |(z, o)|, o the known slip [N]: as a
// force, or, where the bend at z = 0 is sharp, as the distance to the slip that has this force,
// times the stiffness.
inline double lack(const VectorXd &z, const VectorXd &o, const VectorXd &f, double bound,
                   double stiffness) {
  const double size = std::hypot(z.norm(), o.norm());
  if (size == 0)
    return std::max(0., f.norm() - bound);
  const double force = (f - bound * z / size).norm();
  if (o.norm() == 0 || f.norm() >= bound)
    return force;
  const VectorXd slip = f * (o.norm() / std::sqrt(bound * bound - f.squaredNorm()));
  return std::min(force, stiffness * (z - slip).norm());
}

// The conditions that characterise the only minimiser, written out without the solver's own
// functions: the nodal force f - A d lies in the ball where d = 0, and is bound * d / |d|
// elsewhere. Relative to the size of the sums that make the force.
inline double violation(const Problem &p, const VectorXd &d) {
  if (d.size() == 0)
    return 0;
  const VectorXd force = p.force - p.stiffness * d;
  const double size =
      std::max(p.force.cwiseAbs().maxCoeff(), (p.stiffness.cwiseAbs() * d.cwiseAbs()).maxCoeff());
  double worst = 0;
  for (std::size_t i = 0; i < p.points.size(); ++i) {
    const VectorXd di = d.segment(p.points[i].offset, p.points[i].size);
    const VectorXd fi = force.segment(p.points[i].offset, p.points[i].size);
    if (di.size() > 0)
      worst = std::max(worst, lack(di, p.points[i].law.held(), fi, p.bounds[i],
                                   p.stiffness(p.points[i].offset, p.points[i].offset)));
  }
  return size > 0 ? worst / size : worst;
}

class RandomProblems {
 public:
  /// `held`: share of the points that are moved along one of two directions.
  explicit RandomProblems(unsigned seed, double held = 0) : held_(held), random_(seed) {}

  Problem next() {
    const int n_points = std::uniform_int_distribution<int>(1, 40)(random_);
    const int most = std::uniform_int_distribution<int>(1, 2)(random_);
    Problem p;
    Eigen::Index n = 0;
    for (int i = 0; i < n_points; ++i) {
      const int size = std::uniform_int_distribution<int>(0, most)(random_);
      const double weight = std::pow(10., uniform(-3, 1));
      p.bounds.push_back(bound());
      p.points.push_back({n, size, weight, contact::Tresca{p.bounds.back() / weight}});
      if (held_ > 0 && size == 1 && uniform(0, 1) < held_)
        p.points.back().law =
            contact::PointLaw{contact::Tresca{p.bounds.back() / weight}, known_slip()};
      n += size;
    }
    p.stiffness = spd(n);
    p.force =
        VectorXd::NullaryExpr(n, [&] { return normal_(random_) * std::pow(10., uniform(-2, 1)); });
    return p;
  }

  VectorXd vector(Eigen::Index n) {
    return VectorXd::NullaryExpr(n, [&] { return normal_(random_); });
  }

 private:
  double uniform(double a, double b) {
    return std::uniform_real_distribution<double>(a, b)(random_);
  }

  // At rest, and from far less than the slips to more.
  contact::Tangent known_slip() {
    const double size = uniform(0, 1) < 0.1 ? 0 : std::pow(10., uniform(-12, 2));
    return contact::Tangent::Constant(1, normal_(random_) * size);
  }

  // Zero, ordinary and practically infinite bounds.
  double bound() {
    const double which = uniform(0, 1);
    return which < 0.15 ? 0 : which > 0.9 ? 1e6 : std::pow(10., uniform(-3, 1));
  }

  // Q diag Q^T with condition numbers up to 1e8, or a dense kernel like that of a condensed
  // half-space.
  MatrixXd spd(Eigen::Index n) {
    if (uniform(0, 1) < 0.5)
      return MatrixXd::NullaryExpr(n, n,
                                   [&](Eigen::Index i, Eigen::Index j) {
                                     return i == j ? 2.5 + 0.1 * double(n) / (1 + double(i))
                                                   : -1 / (1 + std::pow(double(i - j), 2));
                                   })
                 .eval() +
             MatrixXd::Identity(n, n) * 1.2;
    const MatrixXd q = Eigen::HouseholderQR<MatrixXd>(MatrixXd::NullaryExpr(n, n, [&] {
                         return normal_(random_);
                       })).householderQ();
    const double decades = uniform(0, 8);
    const VectorXd spectrum =
        VectorXd::NullaryExpr(n, [&] { return std::pow(10., uniform(-decades, 0)); });
    const MatrixXd a = q * spectrum.asDiagonal() * q.transpose();
    return (a + a.transpose()) / 2;
  }

  double held_;
  std::mt19937 random_;
  std::normal_distribution<double> normal_;
};

}  // namespace tourmaline::solve
