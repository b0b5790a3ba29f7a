#pragma once

#include <Eigen/Dense>
#include <memory>
#include <span>

#include "contact/friction_bound.h"
#include "contact/normal_law.h"
#include "contact/point_law.h"
#include "output/checkpoint.h"
#include "solve/model.h"

namespace tourmaline::solve {

/// A step at the contact nodes, as every route has it: where a node stood to its foundation and
/// where it stands, the laws of the step, and the slip that they remember. Nodes go by their index
/// in `Model::interface`.
template <int dim>
class ContactStep {
 public:
  using Vector = Eigen::Matrix<double, dim, 1>;
  using Directions = Eigen::Matrix<double, dim, Eigen::Dynamic, 0, dim, dim>;

  /// `model` outlives it.
  explicit ContactStep(const Model<dim> &model);

  /// A step from the state `before`, which outlives it, to `time`.
  void begin(double time, std::span<const double> before);

  Vector displacement(std::span<const double> state, std::size_t node) const;
  /// u_nu - g - u_f.nu [m] of a displacement at the end of the step.
  double penetration(std::size_t node, const Vector &displacement) const;

  std::shared_ptr<const contact::NormalLaw> normal(std::size_t node) const;
  /// As of `ContactLaws`, of a node that supports hold along its normal, at this penetration [m].
  double pressure_under_supports(std::size_t node, double penetration) const;
  bool is_closed_under_supports(std::size_t node, double penetration) const;
  /// The bound that depends on the pressure, or nothing.
  std::shared_ptr<const contact::FrictionBound> bound(std::size_t node) const;
  /// At a place of a contact, with a law's components along `tangent`, the last of which are known
  /// to slip by `held` [m].
  contact::PointLaw friction(const Vector3 &place, std::size_t contact, const Directions &tangent,
                             const contact::Tangent &held) const;

  /// The step is over; slip of its size [m] is added to what a node has slipped.
  void end() { slipped_before_ = slipped_; }
  void add_slip(std::size_t node, double size) {
    slipped_[static_cast<Eigen::Index>(node)] += size;
  }
  /// The step that has ended is to be taken again: its slip is forgotten.
  void take_back() { slipped_ = slipped_before_; }

  /// At the end of the last step [m], by node; empty where no law depends on it.
  Eigen::VectorXd accumulated_slip() const {
    return model_.laws.remembers_slip() ? slipped_ : Eigen::VectorXd();
  }
  void set_accumulated_slip(const Eigen::VectorXd &slip) { slipped_ = slipped_before_ = slip; }
  void save(output::SavedNumbers &numbers) const;
  void restore(const output::SavedNumbers &numbers);

 private:
  const contact::InterfaceNode<dim> &at(std::size_t node) const { return model_.interface[node]; }
  const contact::ContactLaws &laws(std::size_t node) const { return model_.laws.of(at(node)); }
  double penetration_before(std::size_t node) const;

  const Model<dim> &model_;
  double time_ = 0;
  std::span<const double> before_;
  Eigen::VectorXd slipped_, slipped_before_;  // accumulated by node, and a step ago [m]
};

}  // namespace tourmaline::solve
