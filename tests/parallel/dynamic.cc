// Bodies with inertia and damping on one rank and on several.

#include "../cases/thrown_block.h"
#include "ranks.h"

namespace tourmaline::verified {
namespace {

class ThrownOnRanks : public Ranks {
 protected:
  void expect_same_bounce(int dim, const std::string &route, double tolerance) {
    SCOPED_TRACE(route);
    ASSERT_NO_FATAL_FAILURE(run_twice(file_of(thrown_block(dim)) + route));
    expect_equal_quantities(several_.nodes, one_.nodes,
                            {{"u_x", "u_y"}, {"potential"}, {"temperature"}}, tolerance);
    expect_equal_quantities(
        several_.history, one_.history,
        {{"kinetic_energy"}, {"viscous_dissipation"}, {"friction_dissipation"}, {"inertia_y"}},
        tolerance);
  }
};

TEST_P(ThrownOnRanks, ABlockBouncesTheSame) {
  expect_same_bounce(2, "", 1e-9);
  expect_same_bounce(3, "", 1e-9);
  expect_same_bounce(2, " --set solver.method=monolithic", 1e-9);
}

TEST_P(ThrownOnRanks, ABlockBouncesTheSameIteratively) {
  const std::string iteratively =
      " --set solver.body=iterative --set solver.linear_tolerance=1e-13";
  expect_same_bounce(2, iteratively, 1e-8);
  expect_same_bounce(3, iteratively, 1e-8);
}

INSTANTIATE_TEST_SUITE_P(Two, ThrownOnRanks, ::testing::Values(2));

}  // namespace
}  // namespace tourmaline::verified
