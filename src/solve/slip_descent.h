#pragma once

#include <Eigen/Dense>
#include <vector>

#include "solve/interface_newton.h"

namespace tourmaline::solve {

/// The body as the contact sees it where the matrix A of an `InterfaceProgramme` is not at hand:
/// each answer costs solutions of the body's equations.
class SlipResponse {
 public:
  virtual ~SlipResponse() = default;

  /// f - A d, the nodal forces [N] that the contact bears at the slip increments d [m].
  virtual Eigen::VectorXd force(const Eigen::VectorXd &d) = 0;

  /// The direction [m] that solves (A + H) x = descent in the entries of the points with
  /// `is_smooth`, all others zero, H block diagonal: `hessian[i]` [N/m] for such a point. It need
  /// not be exact. Empty where none was found.
  virtual Eigen::VectorXd direction(const std::vector<bool> &is_smooth,
                                    const std::vector<contact::TangentMatrix> &hessian,
                                    const Eigen::VectorXd &descent) = 0;

  /// Size of the forces at the d asked for last [N], to which the tolerance relates.
  virtual double force_size() const = 0;

  /// Error that these forces have at most [N]. A residual that is no larger and falls no more is
  /// taken for zero.
  virtual double force_accuracy() const = 0;
};

/// The programme of `InterfaceProgramme` with A known by its answers alone.
struct SlipProgramme {
  const std::vector<ContactPoint> &points;  ///< disjoint, all entries covered
  const std::vector<double> &curvature;     ///< by point: about the largest of its block of A [N/m]
};

/// Descent in the same programme, with exact responses from any start to its only minimiser:
/// proximal gradient steps, whose length is found so that they descend, each followed by truncated
/// Newton steps that the programme's value accepts (docs/theory.md, section 7). At the end
/// `response` was asked for the increment that is returned.
InterfaceSolution minimise(const SlipProgramme &programme, SlipResponse &response,
                           Eigen::VectorXd start, const InterfaceSettings &settings);

}  // namespace tourmaline::solve
