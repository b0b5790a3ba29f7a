// Strips with many nodes on their contact line, whose friction turns: fronts of contact and of slip
// pass over the nodes one after the other. More than 1,000 unknowns of the contact are solved in
// another way than fewer.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "closed_balances.h"
#include "run_case.h"

namespace tourmaline::verified {
namespace {

std::string strip(int cells, const std::string &lowered, const std::string &normal,
                  const std::string &coefficient = "0.4") {
  return fmt::format(R"toml(
mesh.box = {{ min = [0, 0], max = [0.1, 0.01], cells = [{}, 4], cell = "quadrilateral" }}
material.library = "BaTiO3-Liu2014"
time = {{ end = 1, steps = 3 }}
[[boundary]]
on = "top"
displacement = ["1e-8*t*(1+20*x)", "-1e-8*t*({})"]
potential = 0
temperature = "0.1*t"
[contact]
on = "bottom"
friction = {{ law = "coulomb", coefficient = {} }}
{}
)toml",
                     cells, lowered, coefficient, normal);
}

// Systems that are solved in part would leave more than the balances allow, within the tolerance of
// the contact.
TEST(ManyContactNodes, CloseTheBalancesAsFewDo) {
  for (const int cells : {480, 580, 598}) {
    const RunCase run = run_text(strip(cells, "1-15*x+30*x*t-40*abs(x-0.04)*(1-t)",
                                       "normal = \"unilateral\"\ngap = \"3e-9*(1+sin(200*x))\""));
    expect_closed_balances(run.history(), 1e-11);
  }
}

// From step to step the points change their states along the strip; Newton's method takes more than
// fifty iterations for that, and no other stage is needed.
TEST(ManyContactNodes, ThatChangeTheirStatesOneAfterTheOtherAreSolvedByNewtonsMethodAlone) {
  const std::string stiff = "normal = { law = \"compliance\", coefficient = 1e22 }";
  const RunCase run = run_text(strip(490, "1-15*x+30*x*t", stiff));
  EXPECT_EQ(largest(run.history(), "contact_stage"), 1);
  EXPECT_GT(largest(run.history(), "newton_iterations"), 50);
  expect_closed_balances(run.history(), 1e-11);
}

// Newton's method has no way there, as friction falls with the slip rate; convex programmes with
// held coefficients have one that takes some hundred iterations.
TEST(ManyContactNodes, WithFrictionThatFallsWithTheSlipRateAreSolvedWithHeldCoefficients) {
  for (const int cells : {496, 500}) {
    const RunCase run = run_text(strip(cells, "1-15*x+30*x*t", "normal = \"unilateral\"",
                                       "{ static = 0.4, kinetic = 0.2, speed = 1e-8 }"));
    EXPECT_EQ(largest(run.history(), "contact_stage"), 2) << cells;
    EXPECT_GT(largest(run.history(), "newton_iterations"), 100) << cells;
    expect_closed_balances(run.history(), 1e-11);
  }
}

}  // namespace
}  // namespace tourmaline::verified
