#pragma once

#include <Eigen/Dense>
#include <functional>
#include <vector>

#include "solve/coupled_programme.h"
#include "solve/exchange_point.h"

namespace tourmaline::solve {

/// The contact problem of one step where temperatures or potentials of contact nodes are unknowns,
/// too, because what crosses there depends on the contact's state:
///
///     lambda_i = w_i R_i(lambda_i / w_i + r_i d_i; b_i)      at points,
///     lambda_e + f_e q_e(theta_e, p, delta, w) = 0           at exchanges,    lambda = f - A d.
///
/// A is quasi-definite, negative definite in the entries of exchanges. With q held as a q_0 +
/// q_theta theta these are eliminated, and what is left is a `CoupledProgramme` whose matrix is
/// positive definite again.
struct ExchangeProgramme {
  InterfaceProgramme whole;  ///< with `fields`
  const std::vector<FrictionCoupling> &couplings;
  const std::vector<ExchangePoint> &exchanges;  ///< for each entry behind those of points, in order
};

/// Solves what is left with held exchanges, in entries of points, from a start.
using SolveHeld =
    std::function<CoupledSolution(const InterfaceProgramme &held, const Eigen::VectorXd &start)>;

/// Newton's method on all entries with all derivatives, damped, from `start`; where it stalls,
/// exchanges are held, in a fixed point with Anderson's acceleration, which Newton's method ends as
/// soon as it can. `newton` = false leaves that to the fixed point alone. Increment and force of
/// the solution have the entries of exchanges, too.
CoupledSolution solve_exchanging(const ExchangeProgramme &programme, const Eigen::VectorXd &start,
                                 const InterfaceSettings &settings, const SolveHeld &solve_held,
                                 bool newton = true);

/// What an exchange sees of its node in a solution.
contact::ContactState state_at(const ExchangePoint &at, const std::vector<ContactPoint> &points,
                               const CoupledSolution &solution,
                               const std::vector<FrictionCoupling> &couplings);

}  // namespace tourmaline::solve
