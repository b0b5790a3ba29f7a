#pragma once

#include <memory>
#include <vector>

#include "contact/friction_bound.h"
#include "contact/point_law.h"
#include "solve/anderson.h"
#include "solve/stall.h"

namespace tourmaline::solve {

/// Friction that depends on the pressure, held node by node while a route solves the step with it:
/// a fixed point. Where a node is open it has no friction.
class HeldBounds {
 public:
  /// A contact node as a solution has it.
  struct State {
    double pressure = 0;  ///< [N/m^2]
    bool is_closed = true;
    double slip = 0;  ///< size of the slip increment [m]
  };

  /// Of each node the bound, or nothing: the law that it has, where it touches.
  HeldBounds(std::vector<std::shared_ptr<const contact::FrictionBound>> bounds,
             const std::vector<State> &start);

  /// The law that is held at a node, which has `own` where nothing depends on the pressure.
  contact::PointLaw law(std::size_t node, const contact::PointLaw &own) const;

  /// Takes the state that was found with these laws; true where it asks for no others: bounds that
  /// differ by no more than `tolerance` [N/m^2], or by round-off that no round takes away.
  bool settle(const std::vector<State> &found, double tolerance);

 private:
  Eigen::VectorXd asked_for(const std::vector<State> &states) const;

  std::vector<std::shared_ptr<const contact::FrictionBound>> bounds_;
  Eigen::VectorXd held_;
  std::vector<bool> is_closed_;
  Anderson anderson_;
  Stall stall_;
};

}  // namespace tourmaline::solve
