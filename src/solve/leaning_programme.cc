#include "solve/leaning_programme.h"

#include "larger.h"
#include "solve/force_size.h"

namespace tourmaline::solve {

using Eigen::MatrixXd;
using Eigen::VectorXd;

bool is_carried_off(const InterfaceProgramme &programme, const InterfaceSolution &solution) {
  constexpr double counts = 1e-7;
  return programme.force_scale > 0 &&
         programme.stiffness_error * size_of_forces(programme, solution.increment) >
             counts * programme.force_scale;
}

bool may_have_slid(double round_off, const std::vector<ContactPoint> &points,
                   const std::vector<FrictionCoupling> &couplings,
                   const CoupledSolution &solution) {
  constexpr double counts = 1e-2;
  double most = 0;
  for (const ContactPoint &p : points)
    if (p.law.normal() == nullptr)
      most = larger(most, p.weight * p.law.friction().bound().value_or(0));
  for (std::size_t k = 0; k < solution.friction.size(); ++k)
    most =
        larger(most, points[couplings[k].slip].weight * solution.friction[k].bound().value_or(0));
  return most > 0 && round_off > counts * most;
}

CoupledSolution solve_leaning(const CoupledProgramme &programme, const VectorXd &first,
                              const InterfaceSettings &settings) {
  const InterfaceProgramme &convex = programme.convex;
  CoupledSolution solution = solve_coupled(programme, first, settings);
  int iterations = solution.interface.iterations;
  VectorXd start = VectorXd::Zero(first.size());
  for (const double weak : {1e-2, 1e-4, 1e-6}) {
    const double round_off =
        convex.stiffness_error * size_of_forces(convex, solution.interface.increment);
    if (solution.interface.converged && !is_carried_off(convex, solution.interface) &&
        !may_have_slid(round_off, convex.points, programme.couplings, solution))
      break;
    MatrixXd stiffness = convex.stiffness;
    stiffness.diagonal() *= 1 + weak;
    const InterfaceProgramme sprung{stiffness, convex.force, convex.points, convex.force_scale};
    InterfaceSettings definite = settings;
    definite.is_definite = true;
    definite.factor = nullptr;
    start = solve_coupled({sprung, programme.couplings}, start, definite).interface.increment;
    solution = solve_coupled(programme, start, settings);
    iterations += solution.interface.iterations;
  }
  solution.interface.iterations = iterations;
  return solution;
}

}  // namespace tourmaline::solve
