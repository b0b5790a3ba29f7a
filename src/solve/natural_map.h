#pragma once

#include <Eigen/Dense>
#include <vector>

#include "solve/coupled_programme.h"

namespace tourmaline::solve {

/// The natural map of a coupled programme at some d,
///
///     F_i = lambda_i - w_i R_i(lambda_i / w_i + r_i d_i; b_i),    lambda = f - A d,
///
/// r_i w_i the largest curvature of the point's own block of A. It is zero at solutions, and
/// piecewise smooth. `strength` times the friction bounds are meant.
class NaturalMap {
 public:
  NaturalMap(const CoupledProgramme &programme, double strength);

  /// d and f - A d.
  struct Place {
    Eigen::VectorXd d, force;
  };
  Place at(Eigen::VectorXd d) const;

  Eigen::VectorXd value(const Place &x) const;  ///< F [N]
  /// |F|^2, each point's part over its curvature [m^2].
  double merit(const Place &x) const;
  /// The largest |F_i| over the size of the forces.
  double residual(const Place &x) const;
  std::vector<std::size_t> unsettled(const Place &x, double tolerance) const;

  /// Newton's direction for d; empty where the linear system cannot be solved. Points that are held
  /// go there at once and take no part in it.
  Eigen::VectorXd newton_direction(const Place &x) const;

  /// Lengths between 0 and 1 at which a point changes its branch on the way from x along a
  /// direction, `resisted` = A direction.
  std::vector<double> turns(const Place &x, const Eigen::VectorXd &direction,
                            const Eigen::VectorXd &resisted) const;

  /// Held points put exactly where they are held.
  Place settled(const Place &x) const;

  CoupledSolution solution(const Place &x) const;
  /// The friction laws with the bounds that hold at x.
  std::vector<contact::PointLaw> friction_at(const Place &x) const;

 private:
  struct Pressure {
    double value = 0;
    bool is_closed = false;
  };
  /// A point's law as it is at x, and what its bound depends on.
  struct Branch {
    contact::Tangent trial;  // [N/m^2]
    contact::TangentMatrix derivative;
    contact::Tangent by_bound;  // of the traction
    contact::FrictionBound::Value bound;
    bool is_held = false;  // the row is that of d = 0
  };

  const ContactPoint &point(std::size_t i) const { return convex_.points[i]; }
  contact::Tangent trial(std::size_t i, const Place &x) const;
  Pressure pressure(const FrictionCoupling &coupling, const Place &x) const;
  contact::LocalLaw law(std::size_t i, const Place &x) const;
  contact::PointLaw friction(const FrictionCoupling &coupling, const Place &x) const;
  contact::FrictionBound::Value bound(const FrictionCoupling &coupling, const Place &x) const;
  double slip_size(std::size_t i, const Place &x) const;
  contact::Tangent point_value(std::size_t i, const Place &x) const;
  Branch branch(std::size_t i, const Place &x) const;
  contact::Tangent by_bound(std::size_t i, const Branch &branch, const Place &x) const;
  double excess(std::size_t i, const Place &x) const;

  const InterfaceProgramme &convex_;
  const std::vector<FrictionCoupling> &couplings_;
  double strength_;
  std::vector<double> curvature_;  // by point [N/m]
  std::vector<int> coupling_of_;   // by point; -1: none
};

}  // namespace tourmaline::solve
