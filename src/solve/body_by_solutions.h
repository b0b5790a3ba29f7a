#pragma once

#include <Eigen/Dense>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "solve/body_equations.h"
#include "solve/contact_body.h"
#include "solve/contact_nodes.h"
#include "solve/natural_map.h"
#include "solve/node_system.h"
#include "solve/slip_descent.h"

namespace tourmaline::solve {

/// The body as the contact sees it where the matrix A of the contact's unknowns is known by
/// solutions of the body's equations alone. The state of the step is what these change.
template <int dim>
class BodyBySolutions : public ContactBody, private SlipResponse {
 public:
  /// What is referred to outlives this. `is_leaning`: only the contact keeps the body from some
  /// rigid motion.
  BodyBySolutions(const Model<dim> &model, const std::vector<bool> &is_prescribed,
                  BodyEquations<dim> &body, const ContactNodes<dim> &contact, bool is_leaning);

  /// A step whose state is predicted. A residual of `tolerance` of the contact's forces is none.
  void begin_step(double time, std::span<double> state, double tolerance);
  /// From the state as it is, as no linear solve had moved it yet.
  void begin_anew();
  int iterations() const { return iterations_; }  ///< linear systems of the contact in this step
  void forget_iterations() { iterations_ = 0; }

  const Eigen::VectorXd &unknowns() const { return d_; }  ///< as the state has them
  /// Where the body is with the state as it is, its residual taken anew.
  NaturalMap::Place look();
  /// The same of another residual of the body.
  NaturalMap::Place place(std::span<const double> residual) const;
  /// What contact and prescribed unknowns leave free of a residual of the body.
  std::vector<double> freed(std::vector<double> residual) const;
  /// Conditions that hold the contact nodes.
  std::vector<krylov::NodeTangent<dim>> held() const { return all_held().tangents; }
  /// Puts these unknowns of the contact into the state.
  void put(const Eigen::VectorXd &d);
  /// The state has these unknowns of the contact.
  void take(const Eigen::VectorXd &d) {
    d_ = d;
    is_solved_ = false;
  }
  /// Newton's step for contact and body at once. False where the linear system could not be solved,
  /// its residual taken down by `reduction`. `residual`: what is left free of the body's.
  bool newton_step(const ContactTangent &tangent, std::vector<double> residual, double reduction);

  /// An estimate of the state's forward error: the size of what the linear system of Newton's
  /// method answers to what is left of contact and body, by this residual of the body.
  double forward_error(const ContactTangent &tangent, std::vector<double> residual);

  /// Springs from contact to foundation, over the stiffness of the contact's points: a means to
  /// find a start.
  void set_springs(double springs) { springs_ = springs; }

  /// A [N/m], from one solution of the body's equations by unknown. Nothing where one failed.
  /// `made`: is called with the number of columns that are there, after each.
  std::optional<Eigen::MatrixXd> matrix(const std::function<void(Eigen::Index)> &made);
  /// About that of A, over the size of its entries. Where little but the contact holds the body, A
  /// is told from a singular matrix.
  static constexpr double error_of_matrix = 1e-12;

  /// Nodal forces [N], dim by contact node.
  Eigen::VectorXd at_contact(std::span<const double> vector) const;

  // ContactBody
  Eigen::VectorXd force(const Eigen::VectorXd &d) override;
  double size_of_forces(const Eigen::VectorXd &) const override { return size_; }
  bool is_within(const Eigen::VectorXd &d, double residual, double tolerance) const override;
  double largest_force() const override { return size_; }
  double curvature(std::size_t point) const override { return curvatures_[point]; }
  std::optional<Moved> solve(const ContactTangent &tangent) override;
  Eigen::VectorXd without_contact() override;
  InterfaceSolution minimise(const std::vector<ContactPoint> &points, Eigen::VectorXd start,
                             const InterfaceSettings &settings) override;

 private:
  // SlipResponse
  Eigen::VectorXd direction(const std::vector<bool> &is_smooth,
                            const std::vector<contact::TangentMatrix> &hessian,
                            const Eigen::VectorXd &descent) override;
  double force_size() const override { return size_; }
  double force_accuracy() const override { return model_.asked.solver.linear_tolerance * size_; }

  Eigen::VectorXd increments_of(std::span<const double> state) const;
  Eigen::VectorXd possible(Eigen::VectorXd d) const;
  void add_at_contact(const Eigen::VectorXd &by_node, std::span<double> vector) const;
  double size_at_state() const;
  double round_off_of_slips() const;
  std::vector<double> product(std::span<const double> x) const {
    return model_.product(x, body_.is_refined());
  }
  NodeSystem<dim> all_held() const;
  std::vector<double> set_system(const NodeSystem<dim> &system, const Eigen::VectorXd &moved,
                                 const Eigen::VectorXd &force, std::vector<double> residual);
  void take_off(const Eigen::VectorXd &moved, const NodeSystem<dim> &system,
                Eigen::VectorXd &coupled, std::vector<double> &residual) const;
  bool correct(const NodeSystem<dim> &system, const Eigen::VectorXd &known,
               const Eigen::VectorXd &force, std::vector<double> residual, double reduction);
  ContactTangent with_springs(ContactTangent tangent) const;
  std::optional<Moved> response(const NodeSystem<dim> &system, const Eigen::VectorXd &known,
                                const Eigen::VectorXd &force, double reduction);
  bool add_shares(const NodeSystem<dim> &system, const ContactTangent &tangent, double reduction,
                  Moved &moved);
  ContactTangent of_points(const std::vector<bool> &is_free,
                           const std::vector<contact::TangentMatrix> &hessian,
                           const Eigen::VectorXd &force) const;

  const Model<dim> &model_;
  const std::vector<bool> &is_prescribed_;
  BodyEquations<dim> &body_;
  const ContactNodes<dim> &contact_;
  const bool is_leaning_;
  std::vector<double> curvatures_;  // by point [N/m]
  Eigen::VectorXd stiffness_;       // the same by unknown
  double springs_ = 0;
  // Of the step at hand:
  double time_ = 0, tolerance_ = 0;
  std::span<double> state_;
  Eigen::VectorXd d_;      // unknowns of the contact nodes, as the state has them
  Eigen::VectorXd force_;  // f - A d, where the body is solved with them
  bool is_solved_ = false;
  double size_ = 1;            // of the forces [N]
  std::vector<double> moved_;  // by the body in the last linear solve
  int iterations_ = 0;
};

}  // namespace tourmaline::solve
