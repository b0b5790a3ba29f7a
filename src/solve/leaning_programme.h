#pragma once

#include <Eigen/Dense>
#include <vector>

#include "solve/coupled_programme.h"
#include "solve/interface_newton.h"

/// The contact problem of a body that only its contact keeps from some rigid motion.
namespace tourmaline::solve {

/// Whether the loads carry the body off. Where nothing holds it, round-off of its stiffness does:
/// loads then move it by so much that the round-off of the forces that hold it is a part of them
/// that counts.
bool is_carried_off(const InterfaceProgramme &programme, const InterfaceSolution &solution);

/// Whether friction can bear so little at the contact's points beside `round_off` of their forces
/// [N] that this might hide a slide.
bool may_have_slid(double round_off, const std::vector<ContactPoint> &points,
                   const std::vector<FrictionCoupling> &couplings, const CoupledSolution &solution);

/// `solve_coupled`, and where that fails, as Newton's method may meet a singular matrix on its way,
/// from where weak springs between contact and foundation lead it.
CoupledSolution solve_leaning(const CoupledProgramme &programme, const Eigen::VectorXd &first,
                              const InterfaceSettings &settings);

}  // namespace tourmaline::solve
