#pragma once

#include <Eigen/Dense>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "contact/friction_bound.h"
#include "solve/contact_body.h"
#include "solve/exchange_point.h"
#include "solve/interface_newton.h"
#include "solve/route.h"

namespace tourmaline::solve {

/// Friction at the point `slip` that depends on what happens along the normal: there is none where
/// the point `normal` is open; where it touches, the ball of radius `bound` or, without one, the
/// law that the point has.
struct FrictionCoupling {
  std::size_t slip = 0;               ///< a point of the programme
  std::optional<std::size_t> normal;  ///< likewise; nothing: the pressure is known
  double pressure = 0;                ///< where it is known [N/m^2]
  bool is_closed = false;             ///< likewise
  std::shared_ptr<const contact::FrictionBound> bound;
};

/// The contact problem of one step in penetrations and slip increments d, with lambda = f - A d the
/// nodal forces on the foundation:
///
///     lambda_i = w_i R_i(lambda_i / w_i + r_i d_i; b_i)    for all points i,
///
/// R the law's resolvent with r_i > 0, where the friction bounds b depend on pressure and slip at
/// the end of the step. With b held it is the convex programme `InterfaceProgramme`, the points'
/// own laws those of friction without bound.
struct CoupledProgramme {
  InterfaceProgramme convex;
  const std::vector<FrictionCoupling> &couplings;  ///< at most one for each point
};

/// The same, the body known by its answers.
struct CoupledContact {
  ContactBody &body;
  const std::vector<ContactPoint> &points;
  const std::vector<FrictionCoupling> &couplings;
  std::span<const ExchangePoint> exchanges = {};  ///< `solve_exchanging` is for them
};

struct CoupledSolution {
  InterfaceSolution interface;
  ContactStage stage = ContactStage::newton;
  bool slip_jumped = false;  ///< as in `StepOutcome`
  /// of each coupling: the law at its point, with the bound that holds, and the pressure [N/m^2]
  std::vector<contact::PointLaw> friction;
  std::vector<double> pressure;
};

/// Semismooth Newton's method with the bounds' derivatives, damped so that the scaled natural
/// residual falls, from `start` and along springs or, where the contact cannot open, from the body
/// without contact; where it stalls, convex programmes with held bounds in a fixed point with
/// Anderson's acceleration; then continuation in the size of the bounds. A solution need not exist,
/// nor be the only one, where friction is strong. (V. Acary, M. Bremond, O. Huber, in: Advanced
/// Topics in Nonsmooth Dynamics, Springer 2018.)
CoupledSolution solve_coupled(const CoupledProgramme &programme, const Eigen::VectorXd &start,
                              const InterfaceSettings &settings);
CoupledSolution solve_coupled(const CoupledContact &contact, const Eigen::VectorXd &start,
                              const InterfaceSettings &settings);

/// Whether the body, held by friction that falls from the state of the last step on (of the slip
/// rate: from the one then), is softer along the slips of this step than friction falls. `start`:
/// the increments of the last step.
bool slip_sets_in_unstable(const CoupledContact &contact, const Eigen::VectorXd &start,
                           const CoupledSolution &found);

}  // namespace tourmaline::solve
