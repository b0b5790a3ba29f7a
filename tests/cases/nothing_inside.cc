// Bodies so coarse that nothing is left to eliminate.

#include <gmock/gmock.h>

#include "run_case.h"
#include "tourmaline/case/case.h"

namespace tourmaline::verified {
namespace {

casefile::Case foil(const std::string &cells, const std::string &conditions,
                    const std::string &solver) {
  return casefile::read_text("mesh.box = { min = [0, 0], max = [0.1, 0.1], cells = " + cells +
                                 R"(, cell = "quadrilateral" }
material.library = "BaTiO3-Liu2014"
time = { end = 1, steps = 2 }
output = { fields = false, report = false }
)" + conditions,
                             "foil.toml", {solver});
}

class EachRoute : public ::testing::TestWithParam<const char *> {};

// Held by contact on the left and moved on the right, one cell apart: only contact displacements
// are unknown.
TEST_P(EachRoute, SolvesAFoilOneCellThickAtAContact) {
  const auto conditions = [](double bound) {
    return R"(boundary = [
  { on = ["left", "right"], potential = 0, temperature = 0 },
  { on = "right", displacement = [0, "1e-9*t"] },
]
contact = { on = "left", friction = { law = "tresca", bound = )" +
           std::to_string(bound) + " } }\n";
  };
  for (const char *cells : {"[1, 1]", "[1, 8]", "[1, 400]"}) {
    const RunCase slips(foil(cells, conditions(15), GetParam()));
    const double stiffness = 43e9 / 0.1;  // of pure shear, all along the foil
    for (const double traction : slips.contact().numbers("tangential_traction_y"))
      EXPECT_NEAR(std::abs(traction), 15, 15e-9);
    const RunCase sticks(foil(cells, conditions(1e9), GetParam()));
    for (const double slip : sticks.contact().numbers("slip_y"))
      EXPECT_EQ(slip, 0);
    EXPECT_GT(std::abs(sticks.history().numbers("contact_force_y").back()),
              0.9 * 1e-9 * stiffness * 0.1);
  }
}

// What is prescribed is the solution; its reactions are asked for.
TEST_P(EachRoute, GivesTheReactionsOfABodyAllOfWhichIsPrescribed) {
  const RunCase run(foil("[1, 1]", R"(boundary = [
  { on = ["left", "right"], displacement = ["1e-8*t*x", 0], potential = 0, temperature = 0 },
]
)",
                         GetParam()));
  EXPECT_THAT(run.nodes().numbers("u_x"), ::testing::UnorderedElementsAre(0, 0, 1e-9, 1e-9));
  EXPECT_LT(std::abs(run.history().numbers("force_imbalance").back()), 1e-12);
  EXPECT_GT(run.history().numbers("elastic_energy").back(), 0);
}

INSTANTIATE_TEST_SUITE_P(OfTheBody, EachRoute,
                         ::testing::Values("solver.method=\"condensed\"",
                                           "solver.method=\"monolithic\"",
                                           "solver.body=\"iterative\""));

}  // namespace
}  // namespace tourmaline::verified
