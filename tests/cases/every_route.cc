// Label: analytic. A foundation that moves or carries a body along, and a contact of a thousand
// nodes: the same answer on every route.

#include "closed_balances.h"
#include "contact_status.h"
#include "run_case.h"
#include "same_answer.h"

namespace tourmaline::verified {
namespace {

// Bilateral contact with a gap.
const char *const plane_routes = R"toml(
mesh.box = { min = [0, 0], max = [0.02, 0.01], cells = [10, 5] }
material = { library = "BaTiO3-Liu2014", pyroelectric = [0, 1e-4] }
time = { end = 1, steps = 5 }
boundary = [ { on = "top", displacement = [0, 0], potential = 0, temperature = 0 } ]
[contact]
on = "bottom"
gap = "1e-7*sin(200*x)"
foundation_displacement = ["3e-7*sin(4*t)", "1e-7*t^2 + 1e-5*x*t"]
friction = { law = "tresca", bound = "1e6*(1 + 30*x)" }
heat = { law = "exchange", coefficient = 2e4, foundation_temperature = "20*t" }
)toml";

const char *const solid_routes = R"toml(
mesh.box = { min = [0, 0, 0], max = [0.02, 0.015, 0.01], cells = [5, 4, 3], cell = "hexahedron" }
material = { library = "BaTiO3-Liu2014", pyroelectric = [0, 0, 1e-4] }
time = { end = 1, steps = 4 }
boundary = [ { on = "top", displacement = [0, 0, 0], potential = 0, temperature = 0 } ]
[contact]
on = "bottom"
gap = "1e-7*sin(200*x)*cos(100*y)"
foundation_displacement = ["3e-7*sin(4*t) - 2e-5*y*t", "2e-5*x*t", "1e-7*t^2 + 1e-5*x*t"]
friction = { law = "tresca", bound = "1e6*(1 + 30*x)" }
heat = { law = "exchange", coefficient = 2e4, foundation_temperature = "20*t" }
)toml";

TEST(EveryRoute, HoldsAPlaneBodyAtTheGapOfAFoundationThatMoves) {
  const RunCase condensed = run_text(plane_routes);
  EXPECT_TRUE(has_status(condensed.contact(), "stick"));
  EXPECT_TRUE(has_status(condensed.contact(), "slip"));
  EXPECT_LT(largest(condensed.contact(), "gap"), 1e-18);
  expect_balances(condensed);
  const RunCase monolithic =
      run_text(plane_routes, {"solver.method=monolithic", "solver.tolerance=1e-12"});
  expect_same_answer(monolithic, condensed, 2);
  expect_balances(monolithic, 1e-9);
}

TEST(EveryRoute, HoldsASolidAtTheGapOfAFoundationThatMoves) {
  const RunCase condensed = run_text(solid_routes);
  EXPECT_TRUE(has_status(condensed.contact(), "stick"));
  EXPECT_TRUE(has_status(condensed.contact(), "slip"));
  expect_balances(condensed);
  const RunCase monolithic =
      run_text(solid_routes, {"solver.method=monolithic", "solver.tolerance=1e-12"});
  expect_same_answer(monolithic, condensed, 3);
  const RunCase iterative =
      run_text(solid_routes, {"solver.body=iterative", "solver.linear_tolerance=1e-13"});
  expect_same_answer(iterative, condensed, 3);
  expect_balances(iterative, 1e-9);
}

// A step that begins where the body has been left behind begins without contact.
TEST(EveryRoute, CarriesABodyThatOnlyItsContactHoldsAlongWithTheFoundation) {
  for (const char *moved : {"contact.foundation_displacement=['5e-9*t','3e-9*t']",
                            "contact.foundation_displacement=['2e-8*sin(9*t)','-1e-8*sin(7*t)']"}) {
    const auto run = [&](std::vector<std::string> overrides) {
      overrides.emplace_back(moved);
      return run_text(R"toml(
mesh.box = { min = [0, 0], max = [0.02, 0.004], cells = [3, 3], cell = "quadrilateral" }
material = { library = "BaTiO3-Liu2014", pyroelectric = [0, 1e-4] }
time = { end = 1, steps = 5 }
boundary = [ { on = "top", traction = ["-1e4*sin(t)", "-3e5*t"], potential = 0, temperature = 0 } ]
contact = { on = "bottom", normal = "unilateral", friction = { law = "coulomb", coefficient = 0.6 } }
)toml",
                      overrides);
    };
    const RunCase condensed = run({});
    EXPECT_TRUE(has_status(condensed.contact(), "stick"));
    for (const char *route : {"solver.body=iterative", "solver.method=monolithic"})
      expect_same_answer(run({route}), condensed, 2);
  }
}

// So many unknowns of the contact that the condensed route keeps a factor of them.
TEST(EveryRoute, AgreesOnAContactOfAThousandNodes) {
  const auto run = [](const std::string &laws, std::vector<std::string> overrides = {}) {
    return run_text(R"toml(
mesh.box = { min = [0, 0], max = [0.2, 0.002], cells = [1100, 2], cell = "quadrilateral" }
mesh.modes = "incompatible"
material = { library = "BaTiO3-Liu2014", pyroelectric = [0, 1e-4] }
time = { end = 1, steps = 3 }
boundary = [ { on = "top", potential = 0, temperature = 0, displacement = [
  "1e-6*t*(1 + sin(200*x))", "-2e-7*t*(0.2 + cos(300*x))"] } ]
[contact]
on = "bottom"
heat = { law = "exchange", coefficient = 2e4, foundation_temperature = "20*t" }
)toml" + laws,
                    overrides);
  };
  const std::string coulomb =
      "normal = \"unilateral\"\nfriction = { law = \"coulomb\", coefficient = 0.3 }";
  for (const std::string &laws :
       {coulomb, std::string("friction = { law = \"tresca\", bound = 1e6 }")}) {
    SCOPED_TRACE(laws);
    const RunCase condensed = run(laws);
    EXPECT_GT(condensed.history().numbers("slip").back(), laws == coulomb ? 500 : 1000);
    expect_balances(condensed);
    const RunCase monolithic = run(laws, {"solver.method=monolithic", "solver.tolerance=1e-12"});
    expect_same_answer(condensed, monolithic, 2);
  }
}

}  // namespace
}  // namespace tourmaline::verified
