#include "solve/contact_nodes.h"

#include <gtest/gtest.h>

#include "tourmaline/case/reader.h"

namespace tourmaline::solve {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// A block on rollers whose friction remembers its slip, and one step of it in which all points
/// slip by a micrometre.
class Remembering : public ::testing::Test {
 protected:
  Remembering() : mask_(body::mask_of(model_.prescribed, model_.n_unknowns())) {}

  double slipped(ContactNodes<2> &nodes) {
    const std::vector<double> zero(model_.n_unknowns(), 0.);
    nodes.begin_step(0.5, zero, zero);
    CoupledSolution solution;
    solution.interface.increment = VectorXd::Zero(nodes.n_unknowns());
    solution.interface.force = VectorXd::Zero(nodes.n_unknowns());
    for (const ContactPoint &p : nodes.points()) {
      solution.interface.status.push_back(ContactStatus::slip);
      if (p.law.normal() == nullptr)
        solution.interface.increment.segment(p.offset, p.size).setConstant(1e-6);
    }
    solution.friction.assign(nodes.couplings().size(), contact::PointLaw(contact::Tresca{0}));
    const auto n = static_cast<Index>(model_.interface.size());
    StepOutcome outcome;
    outcome.contact_forces = outcome.friction_forces = VectorXd::Zero(2 * n);
    outcome.friction_bound = outcome.accumulated_slip = VectorXd::Zero(n);
    outcome.status.resize(model_.interface.size());
    nodes.end_step(solution, outcome);
    return outcome.accumulated_slip.maxCoeff();
  }

  const Model<2> model_{casefile::read_text(R"(
mesh.box = { min = [0, 0], max = [1, 1], cells = [2, 2] }
material = { library = "BaTiO3-Liu2014" }
time = { end = 1, steps = 2 }
boundary = [ { on = "top", displacement = [0, 0], potential = 0 } ]
[contact]
on = "bottom"
friction = { law = "coulomb", coefficient = { static = 0.3, kinetic = 0.2, distance = 1e-5 } }
)",
                                            "block.toml", {})};
  const std::vector<bool> mask_;
};

TEST_F(Remembering, SlipAddsUpOverTheSteps) {
  ContactNodes<2> nodes(model_, mask_);
  EXPECT_DOUBLE_EQ(slipped(nodes), 1e-6);
  EXPECT_DOUBLE_EQ(slipped(nodes), 2e-6);
}

// As where a factorisation takes over from an iterative solution.
TEST_F(Remembering, AnotherRouteGoesOnWithTheSlipSoFar) {
  ContactNodes<2> nodes(model_, mask_), others(model_, mask_);
  slipped(nodes);
  others.set_accumulated_slip(nodes.accumulated_slip());
  EXPECT_DOUBLE_EQ(slipped(others), 2e-6);
}

// As where refinement turns out to be worth its while.
TEST_F(Remembering, AStepThatIsTakenAgainCountsOnce) {
  ContactNodes<2> nodes(model_, mask_);
  slipped(nodes);
  slipped(nodes);
  nodes.take_back();
  EXPECT_DOUBLE_EQ(slipped(nodes), 2e-6);
}

}  // namespace
}  // namespace tourmaline::solve
