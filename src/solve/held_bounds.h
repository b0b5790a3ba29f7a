#pragma once

#include <memory>
#include <vector>

#include "contact/friction_bound.h"
#include "contact/point_law.h"
#include "solve/anderson.h"
#include "solve/calm_steps.h"
#include "solve/stall.h"

namespace tourmaline::solve {

/// Friction that depends on the pressure, held node by node while a route solves the step with it:
/// a fixed point. Where a node is open it has no friction. A node that closes without friction and
/// opens with it just touches, and has a share of it, as in `NaturalMap`.
class HeldBounds {
 public:
  /// A contact node as a solution has it.
  struct State {
    double pressure = 0;  ///< [N/m^2]
    bool is_closed = true;
    double slip = 0;      ///< size of the slip increment [m]
    double opening = 0;   ///< where it is open: by the stiffness around it [N/m^2]
    double friction = 0;  ///< size of its traction, with what was held [N/m^2]
  };

  /// Of each node the bound, or nothing: the `own` law that it has, where it touches.
  /// `n_directions`: of slip, on the foundation.
  HeldBounds(std::vector<std::shared_ptr<const contact::FrictionBound>> bounds,
             std::vector<contact::PointLaw> own, Eigen::Index n_directions,
             const std::vector<State> &start);

  /// The law that is held at a node.
  contact::PointLaw law(std::size_t node) const;
  /// Whether a node has opened and closed so often that it may just touch.
  bool is_undecided() const;
  /// Whether a node just touches: it is closed, though round-off may say otherwise.
  bool just_touches(std::size_t node) const;

  /// Takes the state that was found with these laws; true where it asks for no others: bounds that
  /// differ by no more than `tolerance` [N/m^2], or by round-off that no round takes away.
  bool settle(const std::vector<State> &found, double tolerance);

 private:
  double whole_bound(std::size_t node, const State &found) const;
  double asked_for(std::size_t node, const State &found) const;
  Eigen::VectorXd mixed(const Eigen::VectorXd &asked);

  std::vector<std::shared_ptr<const contact::FrictionBound>> bounds_;
  std::vector<contact::PointLaw> own_;
  Eigen::Index n_directions_;
  Eigen::VectorXd held_, whole_;  // bounds, and what they would be of closed nodes [N/m^2]
  std::vector<bool> is_closed_;
  std::vector<int> turns_;  // how often a node has opened or closed
  int rounds_ = 0;
  Anderson anderson_;
  CalmSteps calm_;
  Stall stall_;
};

}  // namespace tourmaline::solve
