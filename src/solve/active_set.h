#pragma once

#include <Eigen/Dense>
#include <span>
#include <vector>

#include "contact/bilateral.h"
#include "contact/point_law.h"
#include "krylov/body_system.h"
#include "output/checkpoint.h"
#include "solve/interface_newton.h"
#include "solve/model.h"
#include "solve/route.h"

namespace tourmaline::solve {

/// The contact points of the iterative route and which of them slip. Point i, with the weight w
/// [m^(dim-1)], moves by its slip increment d [m] over the step,
///
///     u = base + D (D^T u_before + d),    D the orthonormal directions of its slip,
///
/// and the force on the foundation, lambda = D^T (b - K x) / w [N/m^2], is to be that of its law,
///
///     lambda = P(lambda + r d),    r = curvature / w [N/m^3].
///
/// A point in the active set slips; all others have d = 0. Of the arguments `state` is x and
/// `residual` is b - K x, each with an entry for each unknown of the body (SI), whole on every
/// rank.
template <int dim>
class ActiveSet {
 public:
  /// Both outlive the set; `is_prescribed` by unknown of the body.
  ActiveSet(const Model<dim> &model, const std::vector<bool> &is_prescribed);

  bool is_empty() const { return points_.empty(); }

  /// The laws and admissible displacements at `time`. `state` is predicted, with its prescribed
  /// values: a point goes on as it did, unless the prediction turns its slip. `before` is carried
  /// along with the foundation (`Model::carried`).
  void begin_step(double time, std::span<const double> before, std::span<const double> state);

  /// Puts the contact displacements of the slips into the state: a sticking point has none.
  void impose(std::span<double> state) const;
  /// Slips as the state has them now; a point whose slip has turned is caught.
  void read_slips(std::span<const double> state);
  /// Lets those points go whose force is beyond their law; true when there were some.
  bool change(std::span<const double> residual);
  /// The active set that the statuses of the points say.
  void set_active(const std::vector<ContactStatus> &status);

  /// The largest |lambda - P(lambda + r d)| as a nodal force [N].
  double largest_residual(std::span<const double> residual) const;
  /// Size of the contact's forces [N], to which their residual is compared.
  double force_size(std::span<const double> residual) const;
  /// The largest of the nodal forces [N] of the contact nodes in rows of the body.
  double largest_force(std::span<const double> rows) const;
  /// Takes what friction bears where points slip from rows of the body.
  void subtract_friction(std::span<double> rows) const;

  /// What the contact leaves its nodes: nothing; and what slips freely, against the stiffness w H
  /// of the laws' Hessians H.
  std::vector<krylov::NodeTangent<dim>> held() const;
  std::vector<krylov::NodeTangent<dim>> tangents() const;

  /// The same points as those of a programme in all slip increments one after the other.
  std::vector<ContactPoint> programme_points() const;
  std::vector<double> curvatures() const;  ///< by point [N/m]
  Eigen::VectorXd increments() const;      ///< d, zero where a point sticks
  /// Sets all d, and the active set to the points whose law is smooth there.
  void set_increments(const Eigen::VectorXd &d);
  /// The components along the directions of slip of a vector over the body's unknowns.
  Eigen::VectorXd components(std::span<const double> vector) const;
  /// d as the state has it.
  Eigen::VectorXd increments_of(std::span<const double> state) const;
  /// What points with `is_smooth` are left, whose laws have these Hessians w H [N/m].
  std::vector<krylov::NodeTangent<dim>> tangents(
      const std::vector<bool> &is_smooth, const std::vector<contact::TangentMatrix> &hessian) const;
  /// Puts these components [N] of the points with `is_smooth` into rows of the body.
  void put_forces(const std::vector<bool> &is_smooth, const Eigen::VectorXd &components,
                  std::span<double> rows) const;

  /// Statuses, forces and residual of the contact at the end of the step.
  StepOutcome outcome(std::span<const double> residual) const;

  void save(output::SavedNumbers &numbers) const;
  void restore(const output::SavedNumbers &numbers);

 private:
  using Vector = Eigen::Matrix<double, dim, 1>;

  struct Point {
    contact::Admissible<dim> admissible;
    contact::PointLaw friction;
    contact::Tangent slip_before;  // of the last step, D^T u [m]
    contact::Tangent place;        // D^T u where it slips: D^T u_before + d would lose its digits
    contact::Tangent slip;         // d [m]
    bool slips = false;            // in the active set
    Eigen::Index offset = 0;       // of d among those of all points

    Eigen::Index size() const { return admissible.directions.cols(); }
    bool is_held() const { return size() == 0; }
  };

  std::size_t first_unknown(std::size_t node) const;
  Vector at_node(std::span<const double> vector, std::size_t node) const;
  contact::Tangent slip_force(std::span<const double> residual, std::size_t node) const;
  double curvature(std::size_t node) const;
  contact::Tangent slip(std::size_t node) const;
  contact::Tangent trial(std::span<const double> residual, std::size_t node) const;
  double residual_at(std::span<const double> residual, std::size_t node) const;
  void share_forces(std::span<const double> residual, std::size_t node, StepOutcome &outcome) const;

  const Model<dim> &model_;
  const std::vector<bool> &is_prescribed_;
  std::vector<double> diagonal_;  // of K
  std::vector<Point> points_;
};

}  // namespace tourmaline::solve
