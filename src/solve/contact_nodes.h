#pragma once

#include <Eigen/Dense>
#include <Eigen/Sparse>
#include <optional>
#include <span>
#include <vector>

#include "contact/bilateral.h"
#include "output/checkpoint.h"
#include "solve/contact_step.h"
#include "solve/coupled_programme.h"
#include "solve/exchange_point.h"
#include "solve/model.h"
#include "solve/route.h"

namespace tourmaline::solve {

/// The contact nodes as points of a programme. A node has a point for its slip increment and, where
/// the laws ask for it, one for its penetration before it. With z the unknowns of all points one
/// after the other, the displacements of the contact nodes are
///
///     c = held + T (z_stuck + z),
///
/// where z_stuck holds the slips with which all points would stick to the foundation and `held` is
/// what is prescribed, every node touching the foundation; T has orthonormal columns.
template <int dim>
class ContactNodes {
 public:
  /// Both outlive this. Throws CaseError for nodes whose laws need a normal displacement that other
  /// conditions tilt.
  ContactNodes(const Model<dim> &model, const std::vector<bool> &is_prescribed);
  ContactNodes(const Model<dim> &model, std::vector<bool> &&is_prescribed) = delete;

  const Eigen::SparseMatrix<double> &directions() const { return directions_; }  ///< T
  /// Whether friction depends on what happens along the normal.
  bool is_coupled() const { return !couplings_.empty(); }
  Eigen::Index n_unknowns() const { return n_; }
  const std::vector<ContactPoint> &points() const { return points_; }
  /// Entries of z that are not held at zero whatever happens: all but those of bilateral normals.
  std::vector<Eigen::Index> movable() const;
  const std::vector<FrictionCoupling> &couplings() const { return couplings_; }
  std::size_t node_of(std::size_t point) const { return node_of_[point]; }
  /// The points of a node, and what is known of it in the step at hand, as an exchange has them.
  ExchangePoint seen_by_exchange(std::size_t node) const;
  /// What an exchange sees of the node in a solution.
  contact::ContactState state_for_exchange(std::size_t node, const CoupledSolution &solution) const;

  /// The laws of the step that ends at `time`; `state` holds the prescribed values, `before` is the
  /// state of the last step.
  void begin_step(double time, std::span<const double> before, std::span<const double> state);
  Eigen::VectorXd stuck() const {
    return from_ ? *from_ : Eigen::VectorXd(held_ + directions_ * stuck_);
  }
  Eigen::VectorXd displacements(const Eigen::VectorXd &z) const {
    return from_ ? Eigen::VectorXd(*from_ + directions_ * z)
                 : Eigen::VectorXd(held_ + directions_ * (stuck_ + z));
  }

  /// Whether points that slip or are open would have to be displaced far more to stick than they
  /// are: a foundation has slipped away, or a gap is much wider than the body deforms.
  bool loses_digits(const CoupledSolution &solution) const;
  /// Measures these points from where they were a step ago in the place of where they would stick,
  /// and the solution's increments with them: no digits are lost to the difference then.
  void measure_from_before(CoupledSolution &solution);
  /// Takes that back.
  void measure_from_stuck(CoupledSolution &solution);

  /// Of the nodal forces that hold the contact, `outcome.contact_forces`, takes away what supports
  /// bear, and says which part is friction; and the statuses of the nodes.
  void end_step(const CoupledSolution &solution, StepOutcome &outcome);
  /// As of `ContactStep`.
  void take_back() { step_.take_back(); }
  Eigen::VectorXd accumulated_slip() const { return step_.accumulated_slip(); }
  void set_accumulated_slip(const Eigen::VectorXd &slip) { step_.set_accumulated_slip(slip); }

  void save(output::SavedNumbers &numbers) const { step_.save(numbers); }
  void restore(const output::SavedNumbers &numbers) { step_.restore(numbers); }

 private:
  using Vector = Eigen::Matrix<double, dim, 1>;
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  /// A node's points, and the pressure where supports decide it [N/m^2].
  struct Node {
    contact::Admissible<dim> admissible;
    std::size_t normal = none, slip = 0;
    std::size_t coupling = none;
    double pressure = 0;     // of one that supports move along its normal
    bool is_closed = false;  // likewise
    double penetration = 0;  // where the normal's unknown is 0 [m]
  };
  bool is_moved_along_normal(std::size_t i) const {
    return nodes_[i].normal == none && model_.laws.of(model_.interface[i]).can_open();
  }

  bool is_free(std::size_t i, const CoupledSolution &solution) const;
  void add_normal(std::size_t i, std::vector<Eigen::Triplet<double>> &entries);
  void add_slip(std::size_t i, std::vector<Eigen::Triplet<double>> &entries);
  void set_friction(std::size_t i, const Vector &carried);
  void know_pressure(std::size_t i);
  void share_force(std::size_t i, const CoupledSolution &solution, StepOutcome &outcome) const;
  const contact::PointLaw &friction(const Node &node, const CoupledSolution &solution) const;
  ContactStatus status(std::size_t i, const CoupledSolution &solution) const;

  const Model<dim> &model_;
  const std::vector<bool> &is_prescribed_;
  ContactStep<dim> step_;
  std::vector<Node> nodes_;
  std::vector<ContactPoint> points_;
  std::vector<FrictionCoupling> couplings_;
  std::vector<std::size_t> node_of_;  // by point
  Eigen::Index n_ = 0;                // entries of z
  Eigen::SparseMatrix<double> directions_;
  Eigen::VectorXd held_, stuck_;
  Eigen::VectorXd last_;   // displacements a step ago
  Eigen::VectorXd start_;  // z with which all points would be there
  std::optional<Eigen::VectorXd>
      from_;  // where points are with z = 0, if it is not where they stick
  std::vector<double> carried_;
};

}  // namespace tourmaline::solve
