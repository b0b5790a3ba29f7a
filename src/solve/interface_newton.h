#pragma once

#include <Eigen/Dense>
#include <limits>
#include <vector>

#include "contact/local_law.h"
#include "solve/kept_factor.h"

namespace tourmaline::solve {

/// A contact point's place in the interface unknowns d: `size` entries from `offset` on; `weight`
/// [m^(dim-1)] makes nodal forces of the law's tractions.
struct ContactPoint {
  Eigen::Index offset = 0, size = 0;
  double weight = 0;
  contact::LocalLaw law;
  /// The slip or penetration where these entries of d are zero [m]; without entries it is zero.
  contact::Tangent start = contact::Tangent(0);

  /// The slip or penetration at d [m].
  contact::Tangent slip(const Eigen::VectorXd &d) const;
  /// Puts the point where that is exactly so, and where it is exactly zero.
  void put(const contact::Tangent &slip, Eigen::VectorXd &d) const;
  void hold(Eigen::VectorXd &d) const { put(contact::Tangent::Zero(size), d); }
};

/// Rows of another field, temperatures or potentials of contact nodes, behind those of points.
struct FieldRows {
  Eigen::Index begin = 0, size = 0;
  double scale = 0;  ///< size of the terms that their f was summed from [N]
};

/// The contact problem of one step in the slip increments d, or such less the points' `start`:
///
///     minimise  d.A d / 2 - f.d + sum_i w_i j_i(d_i + start_i)
///
/// with A symmetric positive definite and j_i the convex dissipation of the law at point i, in
/// which the known part of the slip is (`PointLaw`). Its nodal friction forces are f - A d, w_i
/// times an element of the subdifferential of j_i.
struct InterfaceProgramme {
  const Eigen::MatrixXd &stiffness;         ///< A [N/m]
  const Eigen::VectorXd &force;             ///< f [N]
  const std::vector<ContactPoint> &points;  ///< disjoint, all entries covered
  double force_scale = 0;  ///< size of the terms that f was summed from [N]: bounds its round-off
  /// With these A is quasi-definite, and the programme is not one that can be minimised.
  std::vector<FieldRows> fields = {};
  double stiffness_error =
      std::numeric_limits<double>::epsilon();  ///< over the size of A's entries

  /// Rows of points.
  Eigen::Index n_forces() const { return fields.empty() ? force.size() : fields.front().begin; }
};

/// What the last step of a large problem, whose systems are solved in part, may leave: of the
/// tolerance. An exact last step would leave round-off.
constexpr double next_to_nothing = 0.01;

struct InterfaceSettings {
  double tolerance = 1e-12;  ///< of the natural residual over the size of the forces
  int max_iterations = 100;
  /// Whether A is definite. If not, the contact itself may hold what A leaves free, and directions
  /// are found for slightly more than A.
  bool is_definite = true;
  KeptFactor *factor = nullptr;  ///< from other programmes with the same A; nothing: none
  /// Rounds of sweeps and Newton steps without a residual a tenth of what it was, after which there
  /// will be no more of them; 0: any number.
  int patience = 0;
  /// Linear systems of all attempts at one problem; each may take `max_iterations` of them.
  int in_all = std::numeric_limits<int>::max();
};

struct InterfaceSolution {
  Eigen::VectorXd increment;          ///< d [m]
  Eigen::VectorXd force;              ///< nodal friction forces w lambda [N]
  std::vector<ContactStatus> status;  ///< by point
  int iterations = 0;                 ///< linear systems solved
  double residual = 0;                ///< natural residual over the size of the forces
  bool converged = false;
  bool is_definite = true;             ///< false: a linear system could not be factorised
  std::vector<std::size_t> unsettled;  ///< points that carry the residual, if not converged
};

/// Whether the foundation yields at any of these points: its law has no kink, but a bend where the
/// body begins to touch.
bool may_yield(const std::vector<ContactPoint> &points);

/// The largest eigenvalue of the point's own block of A [N/m]; 0 where it has no entries.
double largest_curvature(const Eigen::MatrixXd &stiffness, const ContactPoint &point);

/// Truncated nonsmooth Newton iteration: block Gauss-Seidel sweeps, which alone converge from any
/// start because the programme is strictly convex and its nonsmooth part separates by points, then
/// a Newton step in the points where the law is smooth, damped so that the programme's value never
/// grows. (C. Graeser and R. Kornhuber, J. Comput. Math. 27 (2009) 1-44.) `start` is the first
/// guess of d.
InterfaceSolution minimise(const InterfaceProgramme &programme, Eigen::VectorXd start,
                           const InterfaceSettings &settings);

}  // namespace tourmaline::solve
